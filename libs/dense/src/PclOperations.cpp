#include <pcl/features/normal_3d_omp.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "PointOperations.h"
#include "quadmap/dense/DenseCloud.h"

namespace quadmap
{
namespace
{
using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

PclCloud::Ptr pclCloud(const pointOperations::Points& points)
{
  PclCloud::Ptr cloud(new PclCloud);
  cloud->reserve(points.size());
  for (const Eigen::Vector3f& p : points) cloud->emplace_back(p.x(), p.y(), p.z());
  return cloud;
}

std::vector<std::size_t> ascending(const pcl::Indices& indices)
{
  std::vector<std::size_t> sorted(indices.begin(), indices.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

}  // namespace

void requirePcl(const std::string&) {}

std::vector<std::size_t> pointOperations::withoutOutliers(
    const Points& points, int neighbours, double standardDeviations)
{
  if (points.size() < 3)
  {
    std::vector<std::size_t> all(points.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
  }
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
  filter.setInputCloud(pclCloud(points));
  filter.setMeanK(
      std::min(neighbours, static_cast<int>(points.size()) - 1));  // PCL reads beyond them
  filter.setStddevMulThresh(standardDeviations);
  pcl::Indices kept;
  filter.filter(kept);
  return ascending(kept);
}

std::vector<pointOperations::SurfaceNormal> pointOperations::surfaceNormals(
    const Points& points, int neighbours)
{
  std::vector<SurfaceNormal> normals(points.size());
  if (points.empty()) return normals;
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(pclCloud(points));
  estimation.setSearchMethod(
      pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  estimation.setKSearch(neighbours);
  pcl::PointCloud<pcl::Normal> found;
  estimation.compute(found);
  for (std::size_t i = 0; i < normals.size(); ++i)
  {
    const pcl::Normal& n = found[i];
    if (!std::isfinite(n.normal_x) || !std::isfinite(n.curvature)) continue;
    normals[i] = {n.getNormalVector3fMap(), n.curvature};
  }
  return normals;
}

std::vector<std::vector<std::size_t>> pointOperations::connectedParts(
    const Points& points, double distance)
{
  if (points.empty()) return {};
  const PclCloud::Ptr cloud = pclCloud(points);
  pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>);
  tree->setInputCloud(cloud);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(cloud);
  extraction.setSearchMethod(tree);
  extraction.setClusterTolerance(distance);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  std::vector<std::vector<std::size_t>> parts;
  for (const auto& cluster : clusters) parts.push_back(ascending(cluster.indices));
  std::sort(
      parts.begin(), parts.end(),
      [](const auto& a, const auto& b)
      { return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front(); });
  return parts;
}

pointOperations::Points pointOperations::ontoSurface(
    const Points& points, const std::vector<float>& weights, double radius)
{
  if (points.empty()) return {};
  constexpr std::size_t kFewest = 6;  // neighbours that make a plane
  const PclCloud::Ptr cloud = pclCloud(points);
  pcl::search::KdTree<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud);
  Points moved = points;
  pcl::Indices near;
  std::vector<float> squaredDistances;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    tree.radiusSearch(static_cast<pcl::index_t>(i), radius, near, squaredDistances);
    if (near.size() < kFewest) continue;
    float sum = 0;
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    Eigen::Matrix3f squares = Eigen::Matrix3f::Zero();
    std::sort(near.begin(), near.end());  // sums do not depend on the order of the search
    for (const pcl::index_t j : near)
    {
      const auto index = static_cast<std::size_t>(j);
      const Eigen::Vector3f p = points[index] - points[i];
      sum += weights[index];
      mean += weights[index] * p;
      squares += weights[index] * p * p.transpose();
    }
    mean /= sum;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes(
        squares / sum - mean * mean.transpose());
    const Eigen::Vector3f normal = axes.eigenvectors().col(0);
    moved[i] = points[i] + normal.dot(mean) * normal;
  }
  return moved;
}

}  // namespace quadmap
