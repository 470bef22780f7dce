#include "OrientationTable.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>

#include <cmath>

#include "quadmap/geometry/RotationDistance.h"
#include "quadmap/maps/ObjectEstimator.h"

namespace quadmap::observations
{
namespace
{
struct Sum
{
  double count = 0, error_deg = 0;
};
}  // namespace

Rows printOrientationTable(const RunOptions& run, std::ostream& out)
{
  const auto labels = LabelTable::installed();
  std::map<std::string, Sum> sums;  // by the true label
  const auto add = [&](const ObservedFrame& frame)
  {
    for (std::size_t b = 0; b < frame.boxes.objects.size(); ++b)
    {
      const auto& detected = frame.boxes.objects[b];
      const auto& truth = frame.truth[b];
      if (!truth || !truth->orientationDefined) continue;
      const auto view =
          viewOf(detected, frame.T_map_sensor, labels.properties(detected.label), PoseNoise{0, 0});
      if (!view || !view->complete || !view->yawDefined) continue;
      const double yaw = uprightStateOf(truth->object_sensor.transformed(frame.T_map_sensor))[3];
      Sum& sum = sums[truth->label];
      ++sum.count;
      sum.error_deg += std::abs(mrpt::RAD2DEG(nearestEquivalentYaw(view->yaw, yaw) - yaw));
    }
  };
  runScene(run, PerceptionOptions(), labels, add);

  Rows rows;
  out << mrpt::format("%-20s %8s %16s\n", "class", "count", "mean error [deg]");
  for (const auto& [label, sum] : sums)
  {
    out << mrpt::format(
        "%-20s %8.0f %16.2f\n", label.c_str(), sum.count, sum.error_deg / sum.count);
    rows.push_back({
        label, {{"count", sum.count}, {"sum_deg", sum.error_deg}}
    });
  }
  return rows;
}

}  // namespace quadmap::observations
