#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cstddef>
#include <set>
#include <string>

#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** Makes boxes of a scan's pixelLabels, with masks, score 1 and the pixels of the depth image.
 *
 * Each connected group of pixels with one label is an object. A name with a number at its end
 * ("chair_2") is one object, however many parts of it are visible. It gets an instanceId, which is
 * equal for equal names. A pixel may have several labels. Labels in another resolution than the
 * depth image are scaled to it.
 * \param labels The labels that count. Walls, floors and all else that the table lacks are no
 * objects.
 * \param minPixels Groups of fewer pixels of the depth image are ignored.
 * \param unknown Receives the names that the table lacks, without their numbers.
 * \param leftOut Receives how many objects were left out, as an observation has at most
 * CObservationObjects::kMostObjects: those of the most pixels, of equal ones the first. May be
 * null.
 * \return Null when the scan has no pixelLabels; boxes without objects when no label is known.
 * \exception std::runtime_error If the labels' image has other proportions than the depth image,
 * or the masks of its objects take too much memory. */
CObservationObjects::Ptr boxesFromPixelLabels(
    const mrpt::obs::CObservation3DRangeScan& scan,
    const LabelTable& labels,
    int minPixels,
    std::set<std::string>& unknown,
    std::size_t* leftOut = nullptr);

}  // namespace quadmap
