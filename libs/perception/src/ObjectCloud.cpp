#include "ObjectCloud.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace quadmap
{
namespace
{
ImageBox enlarged(const ImageBox& box, double share)
{
  const double dx = share * box.width() + 2.0, dy = share * box.height() + 2.0;
  return {box.x1 - dx, box.y1 - dy, box.x2 + dx, box.y2 + dy};
}

double coverageOf(const DepthCloud& cloud, const ImageBox& box)
{
  const auto range = cloud.cellsOf(box);
  if (range.cells() == 0) return 0.0;
  int valid = 0;
  for (int r = range.r0; r < range.r1; ++r)
    for (int c = range.c0; c < range.c1; ++c) valid += cloud.valid(c, r) ? 1 : 0;
  return static_cast<double>(valid) / range.cells();
}

/** A point nearer than this to its supporting plane belongs to the plane [m]; thin objects (a book)
 * allow less than tall ones. */
double supportTolerance(double z, const LabelProperties& label, const PerceptionOptions& options)
{
  const double allowed = std::min(options.planeTolerance, 0.25 * label.typicalSize.z());
  return std::max(allowed, 2.5 * options.depthSigma(z));
}

struct Candidates
{
  std::vector<ObjectCloud::Cell> cells;
  std::vector<Eigen::Vector3d> points;
};

Candidates collect(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ObjectTask& task,
    const PerceptionOptions& options)
{
  const auto& detection = task.detection;
  const auto& label = task.label;
  const auto& support = task.support;
  const ImageBox box = enlarged(detection->box, options.boxMargin);
  const auto range = cloud.cellsOf(box);
  const auto insideShares = planes.all.sharesWithin(range);
  // Share of a plane inside the box that makes it the object's own; others reach beyond. What hangs
  // on a wall covers much of what is seen of it.
  const double minOwnShare = label.support == UsualSupport::Wall ? 0.85 : 0.5;
  Candidates out;
  for (int r = range.r0; r < range.r1; ++r)
    for (int c = range.c0; c < range.c1; ++c)
    {
      if (!cloud.valid(c, r) || cloud.isFlyingPixel(c, r)) continue;
      if (detection->mask &&
          !detection->mask->contains(
              static_cast<unsigned>(c * cloud.stride()), static_cast<unsigned>(r * cloud.stride())))
        continue;
      const Eigen::Vector3d p = cloud.point(c, r).cast<double>();
      if (support &&
          planes.plane(*support).plane.signedDistance(p) < supportTolerance(p.z(), label, options))
        continue;
      const double tolerance = 0.5 * options.planeTolerance + 2.0 * options.depthSigma(p.z());
      const int plane = planes.all.planeAt(cloud, c, r, tolerance);
      if (plane >= 0 && insideShares[static_cast<std::size_t>(plane)] < minOwnShare) continue;
      out.cells.push_back({c, r});
      out.points.push_back(p);
    }
  return out;
}

/** Connected components of the points: neighbours share a voxel or touch one. */
class VoxelClusters
{
 public:
  VoxelClusters(const std::vector<Eigen::Vector3d>& points, double voxel)
  {
    std::unordered_map<std::int64_t, int> voxelIndex;
    std::vector<Eigen::Vector3i> coordinates;
    std::vector<int> voxelOfPoint;
    for (const auto& p : points)
    {
      const Eigen::Vector3i v = (p / voxel).array().floor().cast<int>();
      const auto [it, isNew] = voxelIndex.try_emplace(key(v), static_cast<int>(coordinates.size()));
      if (isNew) coordinates.push_back(v);
      voxelOfPoint.push_back(it->second);
    }
    const std::vector<int> component = label(coordinates, voxelIndex);
    for (const int v : voxelOfPoint) labels_.push_back(component[static_cast<std::size_t>(v)]);
  }

  int count() const { return count_; }
  const std::vector<int>& labels() const { return labels_; }  //!< Of each point

 private:
  static std::int64_t key(const Eigen::Vector3i& v)
  {
    constexpr std::int64_t kOffset = 1 << 20;
    return ((v.x() + kOffset) << 42) | ((v.y() + kOffset) << 21) | (v.z() + kOffset);
  }

  std::vector<int> label(
      const std::vector<Eigen::Vector3i>& coordinates,
      const std::unordered_map<std::int64_t, int>& voxelIndex)
  {
    std::vector<int> component(coordinates.size(), -1), stack;
    for (std::size_t seed = 0; seed < coordinates.size(); ++seed)
    {
      if (component[seed] >= 0) continue;
      component[seed] = count_;
      stack.push_back(static_cast<int>(seed));
      while (!stack.empty())
      {
        const Eigen::Vector3i v = coordinates[static_cast<std::size_t>(stack.back())];
        stack.pop_back();
        for (int i = 0; i < 27; ++i)
        {
          const auto it =
              voxelIndex.find(key(v + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)));
          if (it == voxelIndex.end() || component[static_cast<std::size_t>(it->second)] >= 0)
            continue;
          component[static_cast<std::size_t>(it->second)] = count_;
          stack.push_back(it->second);
        }
      }
      ++count_;
    }
    return component;
  }

  int count_ = 0;
  std::vector<int> labels_;
};

/** How well a cluster plays the part of the object in the box. */
struct ClusterScore
{
  double centrality = 0;                            // sum of Gaussian weights of its cells
  double x1 = 1e9, y1 = 1e9, x2 = -1e9, y2 = -1e9;  // bounds [cells]

  void add(const ObjectCloud::Cell& cell, double weight)
  {
    centrality += weight;
    x1 = std::min(x1, double(cell.c));
    y1 = std::min(y1, double(cell.r));
    x2 = std::max(x2, double(cell.c));
    y2 = std::max(y2, double(cell.r));
  }
};

int bestCluster(
    const Candidates& candidates,
    const VoxelClusters& clusters,
    const ImageBox& box,
    const DepthCloud& cloud,
    int minPoints)
{
  const double s = cloud.stride();
  const ImageBox target = box.clipped(cloud.camera().width, cloud.camera().height);
  std::vector<ClusterScore> scores(static_cast<std::size_t>(clusters.count()));
  std::vector<int> counts(static_cast<std::size_t>(clusters.count()), 0);
  for (std::size_t i = 0; i < candidates.cells.size(); ++i)
  {
    const auto& cell = candidates.cells[i];
    const double du = (cell.c * s - target.centerX()) / (0.35 * target.width());
    const double dv = (cell.r * s - target.centerY()) / (0.35 * target.height());
    const auto label = static_cast<std::size_t>(clusters.labels()[i]);
    scores[label].add(cell, std::exp(-0.5 * (du * du + dv * dv)));
    ++counts[label];
  }
  int best = -1;
  double bestScore = 0;
  for (std::size_t i = 0; i < scores.size(); ++i)
  {
    if (counts[i] < minPoints) continue;
    const auto& b = scores[i];
    const double fill = imageBoxIoU({b.x1 * s, b.y1 * s, b.x2 * s, b.y2 * s}, target);
    const double score = b.centrality * fill;
    if (score > bestScore)
    {
      bestScore = score;
      best = static_cast<int>(i);
    }
  }
  return best;
}

double medianDepth(const Candidates& candidates)
{
  std::vector<double> z;
  for (const auto& p : candidates.points) z.push_back(p.z());
  const auto middle = z.begin() + static_cast<long>(z.size() / 2);
  std::nth_element(z.begin(), middle, z.end());
  return *middle;
}

}  // namespace

ObjectCloud segmentObject(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const std::vector<ObjectTask>& tasks,
    std::size_t index,
    const PerceptionOptions& options)
{
  const DetectedObject& detection = *tasks[index].detection;
  ObjectCloud out;
  out.coverage = coverageOf(cloud, detection.box);
  out.support = tasks[index].support;
  const Candidates candidates = collect(cloud, planes, tasks[index], options);
  if (static_cast<int>(candidates.points.size()) < options.minPoints) return out;

  const double voxel =
      std::max(options.clusterTolerance, options.clusterToleranceGrowth * medianDepth(candidates));
  const VoxelClusters clusters(candidates.points, voxel);
  const int best = bestCluster(candidates, clusters, detection.box, cloud, options.minPoints);
  for (std::size_t i = 0; i < candidates.points.size(); ++i)
    if (clusters.labels()[i] == best)
    {
      out.cells.push_back(candidates.cells[i]);
      out.points.push_back(candidates.points[i]);
    }
  return out;
}

}  // namespace quadmap
