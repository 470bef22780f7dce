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
/** One object of a map or of a truth, as objects.json has it (doc/formats.md). */
struct ObjectRecord
{
  std::string id;  //!< Written as a number when it is one
  std::string label;
  Ellipsoid object;  //!< `center`, `size` (full sizes of the cuboid) and `rotation` of the file
  bool orientationDefined = true;

  std::optional<unsigned> framesVisible;  //!< Truth: number of frames in which it can be seen
  /** Truth: the object is there while from <= time < to [s since 1970]. An empty `from` or `to`
   * means that the object was there before, or stays. */
  std::optional<double> from, to;
  std::optional<unsigned> observations;         //!< Map: number of measurements that made it
  std::optional<double> existence;              //!< Map: probability that it exists, in [0, 1]
  std::optional<double> firstSeen, lastSeen;    //!< Map: times of measurements [s since 1970]
  std::map<std::string, unsigned> labelCounts;  //!< Map: how often it got which label
  /** Map: covariance of (x, y, z [m], yaw [rad], ln a, ln b, ln c). */
  std::optional<Eigen::Matrix<double, 7, 7>> covariance;
};

/** \exception std::runtime_error On unreadable or malformed files; names file and object. */
std::vector<ObjectRecord> readObjectsJson(const std::string& path);

/** The text of objects.json. \param frame Where the objects are: "map", or the "world" of the true
 *  trajectory. */
std::string objectsToJson(
    const std::vector<ObjectRecord>& objects, const std::string& frame = "map");

/** Writes objects.json under a temporary name and renames it when it is complete.
 * \exception std::runtime_error If the file cannot be written. */
void writeObjectsJson(
    const std::string& path,
    const std::vector<ObjectRecord>& objects,
    const std::string& frame = "map");

}  // namespace quadmap
