#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cstdint>
#include <vector>

namespace quadmap
{
/** A scan as MRPT archives it, with this JPEG file as its colour image. MRPT itself would have to
 * decode the file and to encode it anew, which takes time and loses quality.
 * \param scan Without colour pixels. */
std::vector<std::uint8_t> scanBytes(
    const mrpt::obs::CObservation3DRangeScan& scan, const std::vector<std::uint8_t>& jpeg);

}  // namespace quadmap
