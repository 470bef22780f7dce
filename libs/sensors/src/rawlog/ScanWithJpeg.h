#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cstdint>
#include <vector>

#include "quadmap/base/GzipStream.h"

namespace quadmap
{
/** Writes a scan as MRPT archives it, with this JPEG file as its colour image. MRPT itself would
 * have to decode the file and to encode it anew, which takes time and loses quality.
 * \param scan Without colour pixels, before and after. */
void writeWithJpeg(
    mrpt::obs::CObservation3DRangeScan& scan,
    const std::vector<std::uint8_t>& jpeg,
    GzipFileWriter& to);

}  // namespace quadmap
