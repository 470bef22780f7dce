#include "BoxViews.h"

#include "IsometryOf.h"

namespace quadmap
{
std::optional<bool> DenseBoxView::contains(const Eigen::Vector3d& p_map) const
{
  // The edges of a box err by some pixels: as those of a picture 640 pixels wide.
  constexpr double kSlack = 3.0 / 640;
  const Eigen::Vector3d p = T_optical_map * p_map;
  if (!(p.z() > 0.05)) return std::nullopt;
  const Eigen::Vector2d pixel = camera.project(p);
  if (!(pixel.x() >= 0 && pixel.x() < camera.width && pixel.y() >= 0 && pixel.y() < camera.height))
    return std::nullopt;
  const double slack = kSlack * camera.width;
  const std::array<bool, 4> outside{
      pixel.x() < box.x1 - slack, pixel.y() < box.y1 - slack, pixel.x() > box.x2 + slack,
      pixel.y() > box.y2 + slack};
  bool isUnknown = false;
  for (std::size_t side = 0; side < outside.size(); ++side)
  {
    if (outside[side] && usable[side]) return false;
    isUnknown = isUnknown || outside[side];
  }
  if (isUnknown) return std::nullopt;
  return true;
}

std::optional<DenseBoxView> boxViewOf(const KeyframeScan& image, std::size_t box)
{
  const DetectedObject& seen = image.boxes->objects[box];
  if (!seen.measurement.edges) return std::nullopt;
  DenseBoxView view;
  view.camera = pinholeFrom(image.boxes->cameraParams);
  view.T_optical_map =
      (isometryOf(image.T_map_robot + image.scan->sensorPose) * isometryOf(T_sensor_optical()))
          .inverse();
  view.box = seen.box;
  for (std::size_t side = 0; side < view.usable.size(); ++side)
    view.usable[side] = (*seen.measurement.edges)[side].state == EdgeState::Usable;
  return view;
}

double boxShare(const std::vector<DenseBoxView>& views, const Eigen::Vector3d& p_map)
{
  constexpr std::size_t kTellingPart = 4;  // one in so many views has to have the point
  constexpr std::size_t kTrials = 8;  // a point in none of the first of them is taken for outside
  std::size_t known = 0, inside = 0;
  for (const DenseBoxView& view : views)
  {
    const auto isInside = view.contains(p_map);
    if (!isInside) continue;
    inside += *isInside ? 1 : 0;
    if (++known == kTrials && inside == 0) return 0;
  }
  if (inside == 0 || kTellingPart * inside < views.size()) return 0;
  return static_cast<double>(inside) / static_cast<double>(known);
}

}  // namespace quadmap
