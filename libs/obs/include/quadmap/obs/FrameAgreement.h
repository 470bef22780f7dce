#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <optional>
#include <string>

#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** A camera projects when its focal lengths are beyond 1 px, its centre is a number and its image
 * has a size.
 * \param whose Begins the message: "the scan of sensor ...".
 * \exception std::runtime_error If it does not. */
void requireCalibration(const mrpt::img::TCamera& camera, const std::string& whose);

/** Have two cameras the same focal lengths and centre, to 0.001 px? */
bool sameCalibration(const mrpt::img::TCamera& a, const mrpt::img::TCamera& b);

/** Tells why boxes cannot belong to a scan: they have another image size, calibration (by more than
 * 0.001 px), distortion (by more than 1e-6 in a coefficient) or sensor pose (by more than 1e-6, in
 * metres or in the elements of the rotation). \return One phrase about the boxes, or nothing when
 * both agree. */
std::optional<std::string> mismatch(
    const CObservationObjects& boxes, const mrpt::obs::CObservation3DRangeScan& scan);

}  // namespace quadmap
