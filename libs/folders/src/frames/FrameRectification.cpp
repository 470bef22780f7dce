#include "frames/FrameRectification.h"

#include <mrpt/core/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "frames/ResizedCamera.h"
#include "quadmap/sensors/BoxCheck.h"

namespace quadmap
{
namespace
{
/** A point of the plane at depth 1 as the lens bends it: doc/mathematics.md, (24.2). */
Eigen::Vector2d distorted(const Eigen::Vector2d& p, const mrpt::img::TCamera& camera)
{
  const double k1 = camera.dist[0], k2 = camera.dist[1], p1 = camera.dist[2], p2 = camera.dist[3],
               k3 = camera.dist[4];
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {
      x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
      y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

/** The point that distorted() takes to `bent`. Each step takes away the bend of the point so far;
 * lenses bend by some percent, so that the error falls as quickly. */
Eigen::Vector2d undistorted(const Eigen::Vector2d& bent, const mrpt::img::TCamera& camera)
{
  constexpr int kSteps = 30;
  Eigen::Vector2d p = bent;
  for (int i = 0; i < kSteps; ++i) p += bent - distorted(p, camera);
  return p;
}

Eigen::Vector2d rayOf(const Eigen::Vector2d& pixel, const mrpt::img::TCamera& camera)
{
  return {
      (pixel.x() - camera.cx()) / camera.fx(),  // at depth 1
      (pixel.y() - camera.cy()) / camera.fy()};
}

Eigen::Vector2d pixelOf(const Eigen::Vector2d& ray, const mrpt::img::TCamera& camera)
{
  return {camera.fx() * ray.x() + camera.cx(), camera.fy() * ray.y() + camera.cy()};
}

/** The bounds of what rectification makes of a box's outline. The lens bends its sides, whose
 * farthest point may be between the corners. */
ImageBox boundsOfOutline(
    const ImageBox& box, const mrpt::img::TCamera& from, const mrpt::img::TCamera& to)
{
  constexpr int kSteps = 8;  // along each side
  Eigen::AlignedBox2d bounds;
  for (int i = 0; i <= kSteps; ++i)
  {
    const double s = static_cast<double>(i) / kSteps;
    const double x = box.x1 + s * box.width(), y = box.y1 + s * box.height();
    for (const Eigen::Vector2d& p :
         {Eigen::Vector2d(x, box.y1), Eigen::Vector2d(x, box.y2), Eigen::Vector2d(box.x1, y),
          Eigen::Vector2d(box.x2, y)})
      bounds.extend(pixelOf(undistorted(rayOf(p, from), from), to));
  }
  return {bounds.min().x(), bounds.min().y(), bounds.max().x(), bounds.max().y()};
}

/** Pixels at the border of an image. */
std::vector<Eigen::Vector2d> borderOf(const mrpt::img::TCamera& camera)
{
  constexpr int kSteps = 16;  // along each side
  const Eigen::Vector2d last(camera.ncols - 1.0, camera.nrows - 1.0);
  std::vector<Eigen::Vector2d> border;
  for (int i = 0; i <= kSteps; ++i)
  {
    const Eigen::Vector2d p = last * i / kSteps;
    border.insert(
        border.end(), {
                          {   p.x(),        0},
                          {   p.x(), last.y()},
                          {       0,    p.y()},
                          {last.x(),    p.y()}
    });
  }
  return border;
}

/** The distance from the axis at depth 1, as the lens bends it, where the image folds: from there
 * on the lens takes points that are farther out to ones that are less far. Nothing when it does so
 * only with points that neither the image nor the rectified one shows, both of which go `farthest`
 * out. It follows (24.2) outwards from the axis, without p1 and p2. */
std::optional<double> foldOf(const mrpt::img::TCamera& camera, double farthest)
{
  constexpr double kFarthestPoint = 10;  // a share of `farthest`; who bends more is found otherwise
  constexpr int kSteps = 2000;
  const double k1 = camera.dist[0], k2 = camera.dist[1], k3 = camera.dist[4];
  bool isOutside = false;  // of the image
  for (int i = 1; i <= kSteps; ++i)
  {
    const double r = kFarthestPoint * farthest * i / kSteps, r2 = r * r;
    const double seen = r * (1 + r2 * (k1 + r2 * (k2 + r2 * k3)));
    const double slope = 1 + r2 * (3 * k1 + r2 * (5 * k2 + r2 * 7 * k3));  // of `seen` over r
    isOutside = isOutside || seen >= farthest;
    if (seen < farthest && (isOutside || !(slope > 0))) return std::max(0.0, seen);
    if (isOutside && r > farthest) return std::nullopt;
  }
  return std::nullopt;
}
}  // namespace

std::optional<std::string> whyNotRectifiable(const FolderCamera& camera)
{
  constexpr double kLargestError = 1;  // [px]
  const auto& c = camera.color;
  if (!camera.isDistorted()) return std::nullopt;
  const auto phrase = [&](const char* what, double distance)
  {
    return mrpt::format(
        "the lens (k1=%g k2=%g p1=%g p2=%g k3=%g) %s %.0f px from its centre", c.dist[0], c.dist[1],
        c.dist[2], c.dist[3], c.dist[4], what, distance * c.fx());
  };
  double farthest = 0;
  for (const auto& pixel : borderOf(c)) farthest = std::max(farthest, rayOf(pixel, c).norm());
  if (const auto fold = foldOf(c, farthest)) return phrase("folds the image", *fold);
  for (const auto& pixel : borderOf(c))
  {
    const Eigen::Vector2d found = distorted(undistorted(rayOf(pixel, c), c), c);
    if (!((pixelOf(found, c) - pixel).norm() < kLargestError))
      return phrase("bends the image too much", rayOf(pixel, c).norm());
  }
  return std::nullopt;
}

mrpt::img::TCamera rectifiedCameraOf(const FolderCamera& camera)
{
  mrpt::img::TCamera c = camera.color;
  c.distortion = mrpt::img::DistortionModel::none;
  c.dist.fill(0);
  return camera.depth ? resized(c, camera.depth->camera.ncols, camera.depth->camera.nrows) : c;
}

FrameRectification::FrameRectification(const FolderCamera& camera) :
    from_(camera.color), to_(rectifiedCameraOf(camera))
{
  const int rows = static_cast<int>(to_.nrows), columns = static_cast<int>(to_.ncols);
  mapX_.create(rows, columns, CV_32FC1);
  mapY_.create(rows, columns, CV_32FC1);
  for (int v = 0; v < rows; ++v)
    for (int u = 0; u < columns; ++u)
    {
      const Eigen::Vector2d p = pixelOf(distorted(rayOf({u, v}, to_), from_), from_);
      mapX_.at<float>(v, u) = static_cast<float>(p.x());
      mapY_.at<float>(v, u) = static_cast<float>(p.y());
    }
}

cv::Mat FrameRectification::color(const cv::Mat& image) const
{
  cv::Mat rectified;
  cv::remap(image, rectified, mapX_, mapY_, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  return rectified;
}

cv::Mat FrameRectification::depth(const cv::Mat& image) const
{
  // Between two depths there need be nothing, so none are interpolated.
  cv::Mat rectified;
  cv::remap(image, rectified, mapX_, mapY_, cv::INTER_NEAREST, cv::BORDER_CONSTANT);
  return rectified;
}

ImageBox FrameRectification::box(const ImageBox& box) const
{
  constexpr double kAtBorder = 2;  // detectors round [px]
  if (!box.isValid()) return box;  // left to those who say why
  if (isFarOutside(box, from_.ncols, from_.nrows))
  {
    // No lens was measured there. It stays far outside an image of another size, too.
    const double scale =
        static_cast<double>(std::max(to_.ncols, to_.nrows)) / std::max(from_.ncols, from_.nrows);
    return {scale * box.x1, scale * box.y1, scale * box.x2, scale * box.y2};
  }
  const double right = to_.ncols - 1.0, bottom = to_.nrows - 1.0;
  ImageBox b = boundsOfOutline(box, from_, to_);
  if (box.x1 <= kAtBorder) b.x1 = std::min(b.x1, 0.0);
  if (box.y1 <= kAtBorder) b.y1 = std::min(b.y1, 0.0);
  if (box.x2 >= from_.ncols - 1.0 - kAtBorder) b.x2 = std::max(b.x2, right);
  if (box.y2 >= from_.nrows - 1.0 - kAtBorder) b.y2 = std::max(b.y2, bottom);
  return b;
}

}  // namespace quadmap
