#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstdint>
#include <string>
#include <vector>

namespace quadmap
{
/** The points of an organised PCD file, row by row as in the image they were made from. */
struct PcdCloud
{
  std::size_t width = 0, height = 0;
  std::vector<float> x, y, z;        //!< [m]; not finite where nothing was measured
  std::vector<std::uint32_t> color;  //!< 0xRRGGBB
  mrpt::poses::CPose3D viewpoint;    //!< As the header states it; the identity by default
};

/** Reads a PCD file: text, binary, or compressed. It is read here because PCL, which has a reader,
 * would be needed for nothing else in this library.
 * \exception std::runtime_error If it cannot be read, is not organised (a height of 1), or has no
 * x, y, z and rgb (or rgba) of 4 bytes. Names the file. */
PcdCloud readPcd(const std::string& path);

}  // namespace quadmap
