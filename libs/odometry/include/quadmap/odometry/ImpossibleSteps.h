#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <optional>
#include <string>

#include "quadmap/sensors/RgbdFrame.h"

namespace quadmap
{
/** Finds steps between the poses of successive images that no robot makes, as when its odometry
 * jumps. After a pause of the recording a robot may be anywhere that it can have gone. */
class ImpossibleSteps
{
 public:
  /** Takes the pose of the next image. */
  void add(const RgbdFrame& frame, const mrpt::poses::CPose3D& T_map_robot);

  /** What to tell the user after the last image, one line; empty when there are no such steps. */
  std::string warning() const;

 private:
  struct Pose
  {
    double time;  // [s]
    mrpt::poses::CPose3D T_map_robot;
  };
  std::optional<Pose> last_;
  std::size_t count_ = 0;
  std::string first_;  // Description of the first such step
};

}  // namespace quadmap
