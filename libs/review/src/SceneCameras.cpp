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
constexpr double kMargin = 0.07;  // share of the picture that is left for labels

/** Axis-aligned box of the outline of an object, in the picture plane at 1 m. */
ImageBox outline(const Ellipsoid& object, const RenderCamera& camera)
{
  const double inf = std::numeric_limits<double>::infinity();
  ImageBox box{inf, inf, -inf, -inf};
  const Eigen::Matrix<double, 3, 8> corners =
      camera.axes().transpose() * (object.cuboidCorners().colwise() - camera.eye());
  for (int i = 0; i < 8; ++i)
  {
    const double u = corners(0, i) / -corners(2, i), v = -corners(1, i) / -corners(2, i);
    box = {std::min(box.x1, u), std::min(box.y1, v), std::max(box.x2, u), std::max(box.y2, v)};
  }
  return box;
}

/** Mean overlap of each object with the others in the picture. */
double overlap(const SceneContent& content, const RenderCamera& camera)
{
  std::vector<ImageBox> boxes;
  for (const ObjectRecord& record : content.objects)
    boxes.push_back(outline(record.object, camera));
  double sum = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = 0; j < boxes.size(); ++j)
      if (i != j) sum += imageBoxIoU(boxes[i], boxes[j]);
  return boxes.empty() ? 0.0 : sum / static_cast<double>(boxes.size());
}

/** Share of the cloud that faces the eye. */
double visiblePart(const SceneContent& content, const RenderCamera& camera)
{
  const Eigen::Vector3f toEye = camera.toEye().cast<float>();
  const auto facing = std::count_if(
      content.cloud.begin(), content.cloud.end(),
      [&](const CloudPoint& p) { return p.normal.dot(toEye) > 0; });
  return content.cloud.empty()
             ? 0.0
             : static_cast<double>(facing) / static_cast<double>(content.cloud.size());
}

/** What decides from which side a map is looked at. */
SceneContent deciding(const SceneContent& content)
{
  if (content.objects.empty()) return content;
  SceneContent objects;
  objects.objects = content.objects;
  return objects;
}

}  // namespace

RenderCamera obliqueCamera(const SceneContent& content, double aspect)
{
  constexpr int kDirections = 24;
  const SceneContent parts = deciding(content);
  const std::vector<Eigen::Vector3d> extent = parts.extent();
  RenderCamera best;
  double leastCost = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kDirections; ++i)
  {
    RenderCamera camera;
    camera.verticalFov = 30 * kDegree;
    camera.elevation = 42 * kDegree;
    camera.azimuth = i * 2 * M_PI / kDirections;
    camera = framed(camera, extent, aspect, kMargin);
    // Distance, overlap and visible share weigh about equally over their usual ranges.
    const double cost =
        std::log(camera.distance) + 2 * overlap(parts, camera) - 2 * visiblePart(content, camera);
    if (cost < leastCost) best = camera;
    leastCost = std::min(cost, leastCost);
  }
  return framed(best, content.extent(), aspect, kMargin);
}

RenderCamera cameraFromAbove(const SceneContent& content, double aspect)
{
  RenderCamera camera;
  camera.verticalFov = 12 * kDegree;  // rays are nearly parallel, so that walls hide little
  camera.elevation = 89.9 * kDegree;  // not 90, so that the azimuth says what is up in the picture
  camera.azimuth = -90 * kDegree;     // y of the map is up
  const std::vector<Eigen::Vector3d> extent = deciding(content).extent();
  RenderCamera turned = camera;
  turned.azimuth = 180 * kDegree;  // x of the map is up
  const bool xIsUp = framed(turned, extent, aspect, kMargin).distance <
                     framed(camera, extent, aspect, kMargin).distance;
  return framed(xIsUp ? turned : camera, content.extent(), aspect, kMargin);
}

}  // namespace quadmap
