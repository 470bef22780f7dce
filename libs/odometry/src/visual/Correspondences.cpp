#include "Correspondences.h"

#include <algorithm>
#include <numeric>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "FlowSettings.h"

namespace quadmap
{
Corners findCorners(const VisualImage& image, const VisualOdometryOptions& options)
{
  constexpr double kQuality = 0.0015;  // least quality / best quality: many weak corners help
  Corners corners;
  if (image.gray().empty()) return corners;
  std::vector<cv::Point2f> found;
  cv::goodFeaturesToTrack(
      image.gray(), found, 2 * options.features, kQuality, options.minFeatureDistance);
  for (const auto& pixel : found)
  {
    const double z = image.depthAt(pixel.x, pixel.y);
    if (z <= 0) continue;
    corners.pixels.push_back(pixel);
    corners.points.push_back(image.point(pixel.x, pixel.y, z));
    if (static_cast<int>(corners.pixels.size()) == options.features) break;
  }
  return corners;
}

std::vector<Correspondence> followCorners(
    const VisualImage& from,
    const Corners& corners,
    const VisualImage& to,
    const Eigen::Isometry3d& T_to_from)
{
  std::vector<Correspondence> result;
  if (corners.pixels.empty() || to.gray().empty() || from.gray().size() != to.gray().size())
    return result;
  std::vector<cv::Point2f> pixels;
  std::vector<std::size_t> which;
  std::vector<cv::Point2f> starts;
  for (std::size_t i = 0; i < corners.points.size(); ++i)
  {
    const Eigen::Vector3d p = T_to_from * corners.points[i];
    if (p.z() < 0.1) continue;
    const Eigen::Vector2d pixel = to.camera().project(p);
    if (!to.inside(pixel.x(), pixel.y())) continue;
    which.push_back(i);
    starts.push_back(corners.pixels[i]);
    pixels.emplace_back(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()));
  }
  if (starts.empty()) return result;
  std::vector<unsigned char> found;
  std::vector<float> difference;
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 20, 0.02);
  cv::calcOpticalFlowPyrLK(
      from.pyramid(), to.pyramid(), starts, pixels, found, difference, flow::window(),
      flow::kPyramidLevels, until, cv::OPTFLOW_USE_INITIAL_FLOW);
  for (std::size_t i = 0; i < starts.size(); ++i)
  {
    if (!found[i] || !to.inside(pixels[i].x, pixels[i].y)) continue;
    result.push_back({
        corners.points[which[i]],
        {pixels[i].x, pixels[i].y},
        to.depthAt(pixels[i].x, pixels[i].y)
    });
  }
  return result;
}

Descriptors describe(const VisualImage& image)
{
  constexpr int kCandidates = 6000, kKept = 2000;  // found, and kept after they were spread
  constexpr int kFastThreshold = 2;                // low, because rooms have little texture
  constexpr int kCellsAcross = 16, kCellsDown = 12;
  constexpr std::size_t kPerCell = kKept / (kCellsAcross * kCellsDown) + 4;
  Descriptors result;
  if (image.fullGray().empty()) return result;
  const auto orb =
      cv::ORB::create(kCandidates, 1.2f, 8, 31, 0, 2, cv::ORB::FAST_SCORE, 31, kFastThreshold);
  std::vector<cv::KeyPoint> candidates;
  orb->detect(image.fullGray(), candidates);
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const cv::KeyPoint& a, const cv::KeyPoint& b) { return a.response > b.response; });
  std::vector<std::size_t> inCell(kCellsAcross * kCellsDown, 0);
  std::vector<cv::KeyPoint> kept;
  for (const auto& candidate : candidates)
  {
    const auto cell = [](float x, int size, int cells)
    { return std::min(cells - 1, static_cast<int>(x) * cells / size); };
    const int index = cell(candidate.pt.y, image.fullGray().rows, kCellsDown) * kCellsAcross +
                      cell(candidate.pt.x, image.fullGray().cols, kCellsAcross);
    if (++inCell[static_cast<std::size_t>(index)] <= kPerCell) kept.push_back(candidate);
  }
  orb->compute(image.fullGray(), kept, result.rows);
  for (const auto& keypoint : kept)
    result.pixels.emplace_back(
        (keypoint.pt.x + 0.5) / image.reduction() - 0.5,
        (keypoint.pt.y + 0.5) / image.reduction() - 0.5);
  return result;
}

std::vector<Correspondence> matchDescriptors(
    const VisualImage& from,
    const Descriptors& descriptorsFrom,
    const VisualImage& to,
    const Descriptors& descriptorsTo)
{
  constexpr float kMaxRatio = 0.9f;  // best / second distance; RANSAC removes the rest
  std::vector<Correspondence> result;
  if (descriptorsFrom.rows.rows < 2 || descriptorsTo.rows.rows < 2) return result;
  std::vector<std::vector<cv::DMatch>> matches;
  cv::BFMatcher(cv::NORM_HAMMING).knnMatch(descriptorsFrom.rows, descriptorsTo.rows, matches, 2);
  for (const auto& match : matches)
  {
    if (match.size() < 2 || match[0].distance > kMaxRatio * match[1].distance) continue;
    const Eigen::Vector2d& a = descriptorsFrom.pixels[static_cast<std::size_t>(match[0].queryIdx)];
    const Eigen::Vector2d& b = descriptorsTo.pixels[static_cast<std::size_t>(match[0].trainIdx)];
    const double z = from.depthAt(a.x(), a.y());
    if (z <= 0 || !to.inside(b.x(), b.y())) continue;
    result.push_back({from.point(a.x(), a.y(), z), b, to.depthAt(b.x(), b.y())});
  }
  return result;
}

std::vector<Correspondence> matchDescriptorsNear(
    const VisualImage& from,
    const Descriptors& descriptorsFrom,
    const VisualImage& to,
    const Descriptors& descriptorsTo,
    const Eigen::Isometry3d& T_to_from)
{
  constexpr double kRadius = 6;     // [px]
  constexpr int kMaxDistance = 64;  // of 256; chance is below it once in 10^15 [bits]
  std::vector<Correspondence> result;
  for (int i = 0; i < descriptorsFrom.rows.rows; ++i)
  {
    const Eigen::Vector2d& a = descriptorsFrom.pixels[static_cast<std::size_t>(i)];
    const double z = from.depthAt(a.x(), a.y());
    if (z <= 0) continue;
    const Eigen::Vector3d point = from.point(a.x(), a.y(), z);
    const Eigen::Vector3d p = T_to_from * point;
    if (p.z() < 0.1) continue;
    const Eigen::Vector2d pixel = to.camera().project(p);
    double best = kMaxDistance;
    int bestIndex = -1;
    for (int j = 0; j < descriptorsTo.rows.rows; ++j)
    {
      const Eigen::Vector2d& b = descriptorsTo.pixels[static_cast<std::size_t>(j)];
      if (std::abs(b.x() - pixel.x()) > kRadius || std::abs(b.y() - pixel.y()) > kRadius) continue;
      const double distance =
          cv::norm(descriptorsFrom.rows.row(i), descriptorsTo.rows.row(j), cv::NORM_HAMMING);
      if (distance >= best) continue;
      best = distance;
      bestIndex = j;
    }
    if (bestIndex < 0) continue;
    const Eigen::Vector2d& b = descriptorsTo.pixels[static_cast<std::size_t>(bestIndex)];
    if (to.inside(b.x(), b.y())) result.push_back({point, b, to.depthAt(b.x(), b.y())});
  }
  return result;
}

}  // namespace quadmap
