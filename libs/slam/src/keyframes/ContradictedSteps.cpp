#include "keyframes/ContradictedSteps.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <utility>

namespace quadmap
{
namespace
{
constexpr std::size_t kFewest = 3;   // objects that must agree
constexpr double kAgreement = 0.15;  // of the centres of one object from two views [m]
constexpr double kNotable = 0.4;     // a shorter shift may be an error of the measurements [m]
}  // namespace

ContradictedSteps::View ContradictedSteps::viewOf(const KeyframeTask& keyframe)
{
  View view;
  if (!keyframe.boxes) return view;
  const auto T_odom_sensor = keyframe.T_odom_robot + keyframe.frame.scan->sensorPose;
  for (const auto& object : keyframe.boxes->objects)
  {
    if (!object.measurement.complete) continue;
    const Eigen::Vector3d c = object.measurement.complete->object_sensor.center();
    const auto p = T_odom_sensor.composePoint({c.x(), c.y(), c.z()});
    view.emplace_back(object.label, Eigen::Vector3d(p.x, p.y, p.z));
  }
  return view;
}

/** Number of the objects of `now` that were there before, if all had been shifted. */
std::size_t ContradictedSteps::agreeing(
    const View& before, const View& now, const Eigen::Vector3d& shift)
{
  const auto wasThere = [&](const auto& seen)
  {
    return std::any_of(
        before.begin(), before.end(),
        [&](const auto& old) {
          return old.first == seen.first && (old.second + shift - seen.second).norm() < kAgreement;
        });
  };
  return static_cast<std::size_t>(std::count_if(now.begin(), now.end(), wasThere));
}

void ContradictedSteps::add(const KeyframeTask& keyframe)
{
  const RgbdFrame& frame = keyframe.frame;
  View now = viewOf(keyframe);
  const View before = std::exchange(lastViews_[frame.scan->sensorLabel], now);
  if (agreeing(before, now, Eigen::Vector3d::Zero()) > 0) return;
  for (const auto& [oldLabel, old] : before)
    for (const auto& [label, seen] : now)
    {
      const Eigen::Vector3d shift = seen - old;
      if (label != oldLabel || shift.norm() < kNotable) continue;
      const std::size_t moved = agreeing(before, now, shift);
      if (moved < kFewest) continue;
      if (count_++ == 0)
        first_ = mrpt::format(
            "before record %zu (%s), where %zu objects seem to have moved by %.2f m", frame.record,
            frame.scan->sensorLabel.c_str(), moved, shift.norm());
      return;
    }
}

std::string ContradictedSteps::warning() const
{
  if (count_ == 0) return {};
  return mrpt::format(
      "the objects contradict the odometry, first %s (%zu in all): poses and objects are doubtful",
      first_.c_str(), count_);
}

}  // namespace quadmap
