#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <optional>
#include <string>
#include <vector>

#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** Loads external images, checks the scan and brings it into the one form the rest of the program
 * knows: a range image of depths, with a calibration of its size.
 *  \param imagesFolder Where external images are.
 *  \exception std::runtime_error What is wrong with it, without naming file and record. */
void prepareScan(mrpt::obs::CObservation3DRangeScan& scan, const std::string& imagesFolder);

/** Why these boxes cannot belong to the scan: another image size, calibration or sensor pose. */
std::optional<std::string> mismatch(
    const CObservationObjects& boxes, const mrpt::obs::CObservation3DRangeScan& scan);

/** Removes the boxes nobody can use (not finite, without area, outside the image, a score outside
 * [0, 1]); returns one text for each. */
std::vector<std::string> removeUnusableBoxes(CObservationObjects& boxes);

}  // namespace quadmap
