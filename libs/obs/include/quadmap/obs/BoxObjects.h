#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace quadmap
{
/** Which objects the boxes of a run were taken for, as its report.json tells. */
class BoxObjects
{
 public:
  /** \param report Its path. Without such a file no keyframe is known.
   *  \exception std::runtime_error If it is no report of quadmap-slam; names it. */
  explicit BoxObjects(const std::string& report);

  /** The ids of the objects of a keyframe's boxes, in their order; none for a box that is of no
   *  object. It is empty when the report does not know the keyframe. \param time [s] */
  std::vector<std::optional<unsigned>> of(const std::string& sensor, double time) const;

 private:
  using Key = std::pair<std::string, long long>;  //!< Sensor and time [us]
  std::map<Key, std::vector<std::optional<unsigned>>> byKeyframe_;
};

}  // namespace quadmap
