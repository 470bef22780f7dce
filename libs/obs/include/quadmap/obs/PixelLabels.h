#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <set>
#include <string>

#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** What a scan's pixelLabels say about objects, as boxes with masks and score 1 in its depth image.
 *
 * Each connected group of pixels with one label is an object. A name with a number at its end
 * ("chair_2") is one object however many parts are visible, and gives it an instanceId, equal for
 * equal names. A pixel may have several labels. Labels of another size than the depth image are
 * scaled to it.
 * \param labels The classes that count; walls, floors and whatever else is not in the table are no
 * objects.
 * \param minPixels Groups of fewer pixels of the depth image are ignored.
 * \param unknown Takes the names that pixels have and the table does not, without their numbers.
 * \return Null when the scan has no pixelLabels; without objects when none is known.
 * \exception std::runtime_error If the labels' image has other proportions than the depth image. */
CObservationObjects::Ptr boxesFromPixelLabels(
    const mrpt::obs::CObservation3DRangeScan& scan,
    const LabelTable& labels,
    int minPixels,
    std::set<std::string>& unknown);

}  // namespace quadmap
