#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <string>
#include <vector>

#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** Loads the external images of a scan, checks the scan, and brings it into the form that the rest
 * of the program reads: a range image of depths, with a calibration of its size. \param
 * imagesFolder Folder of the external images. \exception std::runtime_error If the scan is wrong.
 * The message names neither file nor record. */
void prepareScan(mrpt::obs::CObservation3DRangeScan& scan, const std::string& imagesFolder);

/** Removes the boxes that cannot be used (see whyUnusable()). \return One text for each of them. */
std::vector<std::string> removeUnusableBoxes(CObservationObjects& boxes);

}  // namespace quadmap
