#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/geometry/Ellipsoid.h"

namespace quadmap
{
/** One object of a map or of a ground truth, as objects.json has it (doc/formats.md). */
struct ObjectRecord
{
  std::string id;  //!< Written as a number when it is one
  std::string label;
  Ellipsoid object;  //!< JSON: center, size (full edge lengths of the cuboid), rotation
  bool orientationDefined = true;

  std::optional<unsigned> framesVisible;  //!< Ground truth: frames in which it can be seen
  /** Ground truth: it stands there while from <= time < to [s since 1970]; none: from or to ever.
   */
  std::optional<double> from, to;
  std::optional<unsigned> observations;         //!< Map: measurements that made it
  std::optional<double> existence;              //!< Map: probability that it exists, in [0, 1]
  std::map<std::string, unsigned> labelCounts;  //!< Map: how often it was called what
  /** Map: covariance of (x, y, z [m], yaw [rad], ln a, ln b, ln c). */
  std::optional<Eigen::Matrix<double, 7, 7>> covariance;
};

/** \exception std::runtime_error On unreadable or malformed files; names file and object. */
std::vector<ObjectRecord> readObjectsJson(const std::string& path);

/** The text of such a file. */
std::string objectsToJson(const std::vector<ObjectRecord>& objects);

/** Written to a temporary name and renamed when complete. \exception std::runtime_error */
void writeObjectsJson(const std::string& path, const std::vector<ObjectRecord>& objects);

}  // namespace quadmap
