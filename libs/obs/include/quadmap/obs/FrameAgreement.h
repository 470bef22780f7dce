#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <optional>
#include <string>

#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** Tells why boxes cannot belong to a scan: they have another image size, calibration (by more than
 * 0.001 px) or sensor pose (by more than 1e-6, in metres or in the elements of the rotation).
 * \return One phrase about the boxes, or nothing when both agree. */
std::optional<std::string> mismatch(
    const CObservationObjects& boxes, const mrpt::obs::CObservation3DRangeScan& scan);

}  // namespace quadmap
