#include <algorithm>
#include <cmath>
#include <limits>

#include "quadmap/geometry/ImageBox.h"
#include "quadmap/review/SceneBuilder.h"

namespace quadmap
{
namespace
{
constexpr double kDegree = M_PI / 180.0;
constexpr double kMargin = 0.07;  // of the picture, for labels

/** Outline of an object in the picture plane at distance 1 m, as an axis-aligned box. */
ImageBox outline(const Ellipsoid& object, const ViewPoint& view)
{
  const double inf = std::numeric_limits<double>::infinity();
  ImageBox box{inf, inf, -inf, -inf};
  const Eigen::Matrix<double, 3, 8> corners =
      view.axes().transpose() * (object.cuboidCorners().colwise() - view.eye());
  for (int i = 0; i < 8; ++i)
  {
    const double u = corners(0, i) / -corners(2, i), v = -corners(1, i) / -corners(2, i);
    box = {std::min(box.x1, u), std::min(box.y1, v), std::max(box.x2, u), std::max(box.y2, v)};
  }
  return box;
}

/** Mean overlap of each object with the others in the picture. */
double overlap(const SceneContent& content, const ViewPoint& view)
{
  std::vector<ImageBox> boxes;
  for (const ObjectRecord& record : content.objects) boxes.push_back(outline(record.object, view));
  double sum = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = 0; j < boxes.size(); ++j)
      if (i != j) sum += imageBoxIoU(boxes[i], boxes[j]);
  return boxes.empty() ? 0.0 : sum / static_cast<double>(boxes.size());
}

/** Part of the cloud that was seen from the side of the eye. */
double visiblePart(const SceneContent& content, const ViewPoint& view)
{
  const Eigen::Vector3f toEye = view.toEye().cast<float>();
  const auto facing = std::count_if(
      content.cloud.begin(), content.cloud.end(),
      [&](const CloudPoint& p) { return p.normal.dot(toEye) > 0; });
  return content.cloud.empty()
             ? 0.0
             : static_cast<double>(facing) / static_cast<double>(content.cloud.size());
}

}  // namespace

ViewPoint obliqueView(const SceneContent& content, double aspect)
{
  constexpr int kDirections = 24;
  const std::vector<Eigen::Vector3d> extent = content.extent();
  ViewPoint best;
  double leastCost = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kDirections; ++i)
  {
    ViewPoint view;
    view.verticalFov = 30 * kDegree;
    view.elevation = 42 * kDegree;
    view.azimuth = i * 2 * M_PI / kDirections;
    view = framed(view, extent, aspect, kMargin);
    // Being near, overlap and visibility weigh about equally over their usual ranges.
    const double cost =
        std::log(view.distance) + 2 * overlap(content, view) - 2 * visiblePart(content, view);
    if (cost < leastCost) best = view;
    leastCost = std::min(cost, leastCost);
  }
  return best;
}

ViewPoint topView(const SceneContent& content, double aspect)
{
  ViewPoint view;
  view.verticalFov = 12 * kDegree;  // nearly parallel rays: walls and sides stay out of the way
  view.elevation = 89.9 * kDegree;  // the azimuth still says which way is up in the picture
  view.azimuth = -90 * kDegree;     // y of the map
  const std::vector<Eigen::Vector3d> extent = content.extent();
  ViewPoint turned = view;
  turned.azimuth = 180 * kDegree;  // x of the map
  const ViewPoint yUp = framed(view, extent, aspect, kMargin);
  const ViewPoint xUp = framed(turned, extent, aspect, kMargin);
  return xUp.distance < yUp.distance ? xUp : yUp;
}

}  // namespace quadmap
