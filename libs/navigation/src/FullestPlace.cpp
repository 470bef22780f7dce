#include "FullestPlace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace quadmap
{
LevelPose fullestPlace(
    const std::vector<LevelPose>& poses,
    const std::vector<double>& weights,
    double width,
    double angle)
{
  struct Sum
  {
    double weight = 0, sine = 0, cosine = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
  };
  constexpr double kTurn = 2 * M_PI;
  const long parts = std::max(1L, std::lround(kTurn / angle));
  const auto yawCell = [&](double yaw)
  {
    const long part = std::lround(yaw / kTurn * static_cast<double>(parts)) % parts;
    return part < 0 ? part + parts : part;
  };
  const auto cell = [&](double value) { return std::lround(value / width); };
  std::map<std::array<long, 3>, Sum> cells;
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    const LevelPose& p = poses[i];
    Sum& sum = cells[{cell(p.position.x()), cell(p.position.y()), yawCell(p.yaw)}];
    sum.weight += weights[i];
    sum.position += weights[i] * p.position;
    sum.sine += weights[i] * std::sin(p.yaw);
    sum.cosine += weights[i] * std::cos(p.yaw);
  }
  const Sum& best =
      std::max_element(
          cells.begin(), cells.end(),
          [](const auto& a, const auto& b) { return a.second.weight < b.second.weight; })
          ->second;
  return {best.position / best.weight, std::atan2(best.sine, best.cosine)};
}

}  // namespace quadmap
