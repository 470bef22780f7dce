#include "ScenePlanes.h"

#include <pcl/features/integral_image_normal.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/edge_aware_plane_comparator.h>
#include <pcl/segmentation/organized_multi_plane_segmentation.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace quadmap
{
namespace
{
using PclCloud = pcl::PointCloud<pcl::PointXYZ>;
using PclNormals = pcl::PointCloud<pcl::Normal>;

constexpr int kPlaneStride = 2;  // of the cloud's cells: 160x120 for the usual sensors

PclCloud::Ptr reducedCloud(const DepthCloud& cloud)
{
  auto out = std::make_shared<PclCloud>();
  out->width = static_cast<unsigned>(cloud.columns() / kPlaneStride);
  out->height = static_cast<unsigned>(cloud.rows() / kPlaneStride);
  out->is_dense = false;
  out->points.reserve(out->width * out->height);
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (unsigned r = 0; r < out->height; ++r)
    for (unsigned c = 0; c < out->width; ++c)
    {
      const int cc = static_cast<int>(c) * kPlaneStride, rr = static_cast<int>(r) * kPlaneStride;
      if (cloud.valid(cc, rr))
      {
        const Eigen::Vector3f p = cloud.point(cc, rr);
        out->points.emplace_back(p.x(), p.y(), p.z());
      }
      else
        out->points.emplace_back(nan, nan, nan);
    }
  return out;
}

using NormalEstimation = pcl::IntegralImageNormalEstimation<pcl::PointXYZ, pcl::Normal>;

void configure(NormalEstimation& estimation, const PclCloud::Ptr& cloud)
{
  estimation.setNormalEstimationMethod(estimation.COVARIANCE_MATRIX);
  estimation.setMaxDepthChangeFactor(0.03f);
  estimation.setNormalSmoothingSize(8.0f);
  estimation.setInputCloud(cloud);
}

/** Connects cells of one plane, but not around the edges of objects: smoothed normals turn there
 * step by step, and planes that leak into each other are lost. */
pcl::EdgeAwarePlaneComparator<pcl::PointXYZ, pcl::Normal>::Ptr edgeAwareComparator(
    NormalEstimation& estimation)
{
  auto comparator = pcl::make_shared<pcl::EdgeAwarePlaneComparator<pcl::PointXYZ, pcl::Normal>>(
      estimation.getDistanceMap());
  comparator->setCurvatureThreshold(0.05f);   // a plane at 3 m shows 0.04 by its noise
  comparator->setDistanceMapThreshold(2.0f);  // cells between a plane and a depth edge
  return comparator;
}

/** Share of the cloud's points that lie more than `margin` behind (below) the plane. */
double shareBelow(const DepthCloud& cloud, const Plane& plane, double margin)
{
  constexpr int kStep = 4;  // a statistic over some 5000 points is enough
  int below = 0, all = 0;
  for (int r = 0; r < cloud.rows(); r += kStep)
    for (int c = 0; c < cloud.columns(); c += kStep)
      if (cloud.valid(c, r))
      {
        ++all;
        const Eigen::Vector3d p = cloud.point(c, r).cast<double>();
        if (plane.signedDistance(p) < -margin * std::max(1.0, 0.5 * p.z())) ++below;
      }
  return all > 0 ? static_cast<double>(below) / all : 0.0;
}

}  // namespace

int PlaneSegmentation::planeAt(const DepthCloud& cloud, int c, int r, double tolerance) const
{
  const Eigen::Vector3d p = cloud.point(c, r).cast<double>();
  int best = -1;
  double bestDistance = tolerance;
  for (int dr = -2; dr <= 2; dr += 2)  // the segmentation leaves out the rim of each plane
    for (int dc = -2; dc <= 2; dc += 2)
    {
      const int cc = c / kPlaneStride + dc, rr = r / kPlaneStride + dr;
      if (cc < 0 || rr < 0 || cc >= columns_ || rr >= rows_) continue;
      const int label = labels_[static_cast<std::size_t>(rr * columns_ + cc)];
      if (label < 0) continue;
      const double distance =
          std::abs(planes[static_cast<std::size_t>(label)].plane.signedDistance(p));
      if (distance < bestDistance)
      {
        bestDistance = distance;
        best = label;
      }
    }
  return best;
}

std::vector<double> PlaneSegmentation::sharesWithin(const DepthCloud::CellRange& range) const
{
  std::vector<double> inside(planes.size(), 0.0);
  for (int r = range.r0 / kPlaneStride; r < std::min(rows_, range.r1 / kPlaneStride); ++r)
    for (int c = range.c0 / kPlaneStride; c < std::min(columns_, range.c1 / kPlaneStride); ++c)
    {
      const int label = labels_[static_cast<std::size_t>(r * columns_ + c)];
      if (label >= 0) inside[static_cast<std::size_t>(label)] += 1.0;
    }
  const double cells = static_cast<double>(labels_.size());
  for (std::size_t i = 0; i < planes.size(); ++i)
    inside[i] = planes[i].share > 0 ? inside[i] / (planes[i].share * cells) : 0.0;
  return inside;
}

PlaneSegmentation segmentPlanes(const DepthCloud& cloud, const PerceptionOptions& options)
{
  const auto points = reducedCloud(cloud);
  NormalEstimation estimation;
  configure(estimation, points);
  const auto normals = pcl::make_shared<PclNormals>();
  estimation.compute(*normals);
  const double cells = static_cast<double>(points->size());

  pcl::OrganizedMultiPlaneSegmentation<pcl::PointXYZ, pcl::Normal, pcl::Label> segmentation;
  segmentation.setMinInliers(static_cast<unsigned>(std::max(30.0, options.planeMinArea * cells)));
  segmentation.setComparator(edgeAwareComparator(estimation));
  segmentation.setAngularThreshold(0.10);
  segmentation.setDistanceThreshold(0.03);
  segmentation.setMaximumCurvature(0.02);
  segmentation.setInputCloud(points);
  segmentation.setInputNormals(normals);
  std::vector<pcl::ModelCoefficients> coefficients;
  std::vector<pcl::PointIndices> inliers;
  segmentation.segment(coefficients, inliers);

  std::vector<std::size_t> order(inliers.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(
      order.begin(), order.end(),
      [&](auto a, auto b) { return inliers[a].indices.size() > inliers[b].indices.size(); });

  PlaneSegmentation out;
  out.columns_ = static_cast<int>(points->width);
  out.rows_ = static_cast<int>(points->height);
  out.labels_.assign(points->size(), -1);
  for (const std::size_t i : order)
  {
    const auto& v = coefficients[i].values;
    ScenePlane plane;
    plane.plane.n = Eigen::Vector3d(v[0], v[1], v[2]);
    const double norm = plane.plane.n.norm();
    if (!(norm > 1e-6)) continue;
    plane.plane.n /= norm;
    plane.plane.d = v[3] / norm;
    if (plane.plane.d < 0) plane.plane = {-plane.plane.n, -plane.plane.d};  // towards the camera
    for (const int index : inliers[i].indices)
    {
      plane.centroid += (*points)[static_cast<std::size_t>(index)].getVector3fMap().cast<double>();
      out.labels_[static_cast<std::size_t>(index)] = static_cast<int>(out.planes.size());
    }
    plane.centroid /= static_cast<double>(inliers[i].indices.size());
    plane.share = static_cast<double>(inliers[i].indices.size()) / cells;
    out.planes.push_back(plane);
  }
  return out;
}

std::optional<Eigen::Vector3d> upFromPlanes(
    const DepthCloud& cloud, const std::vector<ScenePlane>& planes)
{
  // The scene stands on its floor: hardly anything is below it. Walls have that property too, so
  // among such planes the one that faces most against the image's lower half wins by its size.
  constexpr double kMargin = 0.08;  // [m]
  constexpr double kMaxBelow = 0.03;
  const ScenePlane* best = nullptr;
  double bestScore = 0;
  for (const auto& plane : planes)
  {
    if (shareBelow(cloud, plane.plane, kMargin) > kMaxBelow) continue;
    const Eigen::Vector2d direction = plane.centroid.head<2>() / plane.centroid.z();
    const double score = plane.share * (1.0 + direction.norm());  // floors lie off the optical axis
    if (score > bestScore)
    {
      bestScore = score;
      best = &plane;
    }
  }
  if (!best) return {};
  return best->plane.n;
}

ScenePlanes classifyPlanes(
    const DepthCloud& cloud,
    PlaneSegmentation segmentation,
    const Eigen::Vector3d& up,
    const std::optional<Plane>& knownFloor,
    const PerceptionOptions& options)
{
  constexpr double kFloorMargin = 0.06;  // [m]
  constexpr double kMaxBelowFloor = 0.03;
  ScenePlanes out;
  out.all = std::move(segmentation);
  out.up = up.normalized();
  for (int i = 0; i < static_cast<int>(out.all.planes.size()); ++i)
  {
    const double cosine = out.plane(i).plane.n.dot(out.up);
    if (cosine > std::cos(options.planeMaxTilt))
      out.horizontal.push_back(i);
    else if (std::abs(cosine) < std::sin(options.planeMaxTilt))
      out.vertical.push_back(i);
  }
  const auto height = [&](int i) { return out.plane(i).centroid.dot(out.up); };
  std::stable_sort(
      out.horizontal.begin(), out.horizontal.end(),
      [&](int a, int b) { return height(a) < height(b); });
  if (!out.horizontal.empty())
  {
    // Only the lowest can be the floor, and only when nothing shows under it.
    const int lowest = out.horizontal.front();
    if (shareBelow(cloud, out.plane(lowest).plane, kFloorMargin) <= kMaxBelowFloor)
      out.floor = lowest;
  }
  out.floorSeen = out.floor.has_value();
  constexpr double kSameFloor = 0.12;  // [m]; a table top is higher above the floor than this
  const bool isTooHigh = out.floor && knownFloor &&
                         knownFloor->signedDistance(out.plane(*out.floor).centroid) > kSameFloor;
  if (knownFloor && (!out.floor || isTooHigh))
  {
    out.floorSeen = false;
    out.floor = static_cast<int>(out.all.planes.size());
    out.all.planes.push_back({*knownFloor, 0.0, -knownFloor->d * knownFloor->n});
    out.horizontal.insert(out.horizontal.begin(), *out.floor);
  }
  return out;
}

}  // namespace quadmap
