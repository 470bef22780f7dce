#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace quadmap
{
/** A point of a surface that many images saw. */
struct DensePoint
{
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  //!< In the map [m]
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();    //!< Unit, to where it was seen from
  float curvature = 0;  //!< Share of the smallest of the principal spreads around it, in [0, 1/3]
  std::array<std::uint8_t, 3> rgb{};
};
using DenseCloud = std::vector<DensePoint>;

/** \exception std::runtime_error When the program was built without PCL, with what it was asked
 * for. \param what An option, "--cloud". */
void requirePcl(const std::string& what);

/** Whether the name ends as that of a file that writeCloud() can write: .pcd or .ply. */
bool isCloudName(const std::string& path);

/** Writes position, normal, curvature and colour of each point, as binary PCD (rgb packed into a
 * float, as PCL does) or binary PLY, by the end of the name. The file appears complete or not at
 * all. \exception std::runtime_error If it cannot be written.
 * \exception std::invalid_argument For another end of the name. */
void writeCloud(const DenseCloud& cloud, const std::string& path);

}  // namespace quadmap
