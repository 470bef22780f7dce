#include "cloud/MainCluster.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cloud/Cluster.h"
#include "cloud/Precision.h"
#include "quadmap/geometry/RobustStatistics.h"
#include "quadmap/surfaces/HorizontalTop.h"
#include "quadmap/surfaces/PointClusters.h"
#include "quadmap/surfaces/SurfaceTolerance.h"
#include "support/SupportRing.h"

namespace quadmap
{
namespace
{

/** Weights exp(-((i - middle) / sigma)^2 / 2) of i = first ... last - 1. */
std::vector<double> gaussian(int first, int last, double middle, double sigma)
{
  std::vector<double> out;
  for (int i = first; i < last; ++i)
    out.push_back(std::exp(-0.5 * (i - middle) * (i - middle) / (sigma * sigma)));
  return out;
}

/** Pairs of neighbouring candidates that are farther apart in depth than `gap` [m], with cells
 * between them that are not: one surface, seen at a flat angle. */
std::vector<std::pair<int, int>> steepNeighbours(
    const DepthCloud& cloud, const BoxCandidates& candidates, double gap)
{
  const int step = candidates.step;
  const auto& cells = candidates.cells;
  std::vector<std::pair<int, int>> out;
  const auto check = [&](int i, int j)
  {
    const auto &a = cells[static_cast<std::size_t>(i)], &b = cells[static_cast<std::size_t>(j)];
    const float whole = cloud.depth(b.c, b.r) - cloud.depth(a.c, a.r);
    if (std::abs(whole) <= gap || std::abs(whole) > step * gap) return;
    const int dc = b.c > a.c ? 1 : 0, dr = 1 - dc;
    for (int k = 1; k <= step; ++k)
    {
      const float from = cloud.depth(a.c + (k - 1) * dc, a.r + (k - 1) * dr);
      const float to = cloud.depth(a.c + k * dc, a.r + k * dr);
      if (!(to > 0) || std::abs(to - from) > gap) return;
    }
    out.emplace_back(i, j);
  };
  std::vector<int> above(static_cast<std::size_t>(cloud.columns()), -1);  // last of each column
  for (int i = 0; i < static_cast<int>(cells.size()); ++i)
  {
    const auto& cell = cells[static_cast<std::size_t>(i)];
    const auto isCell = [&](int j, int c, int r)
    {
      return j >= 0 && cells[static_cast<std::size_t>(j)].c == c &&
             cells[static_cast<std::size_t>(j)].r == r;
    };
    int& last = above[static_cast<std::size_t>(cell.c)];
    if (isCell(i - 1, cell.c - step, cell.r)) check(i - 1, i);
    if (isCell(last, cell.c, cell.r - step)) check(last, i);
    last = i;
  }
  return out;
}

/** Describes the clusters of one box and chooses among them. */
class ClusterChoice
{
 public:
  /** All references must outlive it. */
  ClusterChoice(
      const DepthCloud& cloud,
      const ScenePlanes& planes,
      const ObjectTask& task,
      const BoxCandidates& candidates,
      const PerceptionOptions& options) :
      cloud_(cloud), planes_(planes), task_(task), candidates_(candidates), options_(options)
  {
  }

  /** The gap that parts of one object may have, equation (7.3): a share of the size of the object,
   * but no less than the sampling needs [m]. */
  double gapAt(double range) const
  {
    const ImageBox& box = task_.detection->box;
    const double size = std::sqrt(box.area()) * range / std::abs(cloud_.camera().fx);
    return std::max(
        options_.clusterToleranceGrowth * range,
        std::min(options_.clusterTolerance, options_.clusterToleranceShare * size));
  }

  /** Measures each cluster against the box. */
  std::vector<Cluster> describe(const PointClusters& parts) const
  {
    constexpr double kCentrality =
        0.35;  // of the box's size; what is near its middle is mostly the object's
    const double s = cloud_.stride();
    const ImageBox target =
        task_.detection->box.clipped(cloud_.camera().width, cloud_.camera().height);
    const auto& range = candidates_.range;
    const auto columnWeights =
        gaussian(range.c0, range.c1, target.centerX() / s, kCentrality * target.width() / s);
    const auto rowWeights =
        gaussian(range.r0, range.r1, target.centerY() / s, kCentrality * target.height() / s);
    std::vector<Cluster> clusters(static_cast<std::size_t>(parts.count()));
    for (std::size_t i = 0; i < candidates_.cells.size(); ++i)
    {
      const auto& cell = candidates_.cells[i];
      auto& cluster = clusters[static_cast<std::size_t>(parts.labels()[i])];
      cluster.add(
          cell, candidates_.points[i].z(),
          columnWeights[static_cast<std::size_t>(cell.c - range.c0)] *
              rowWeights[static_cast<std::size_t>(cell.r - range.r0)]);
      cluster.leaking += goesOn(cell);
    }
    const double outline = 2.0 * (range.c1 - range.c0 + range.r1 - range.r0) / candidates_.step;
    for (auto& b : clusters)
    {
      b.count *= candidates_.step * candidates_.step;
      b.fill = imageBoxIoU({b.x1 * s, b.y1 * s, b.x2 * s, b.y2 * s}, target);
      b.leak = std::min(1.0, b.leaking / outline);
    }
    return clusters;
  }

  /** The cluster with the best score, equation (7.4); -1 when none is large enough. */
  int bestOf(const std::vector<Cluster>& clusters) const
  {
    int best = -1;
    double bestScore = 0;
    for (std::size_t i = 0; i < clusters.size(); ++i)
      if (clusters[i].count >= options_.minPoints && clusters[i].score() > bestScore)
      {
        bestScore = clusters[i].score();
        best = static_cast<int>(i);
      }
    return best;
  }

  /** The candidates of the main cluster and of the parts that join it. The parts of a table lie
   * under its top; what stands beside its legs is a chair.
   * \param labels The cluster of each candidate. */
  std::vector<std::size_t> membersOf(
      const std::vector<int>& labels, const std::vector<Cluster>& clusters, int best) const
  {
    const Cluster& main = clusters[static_cast<std::size_t>(best)];
    const Eigen::Vector2d down = downInImage(cloud_.camera(), planes_.up, task_.detection->box);
    std::vector<bool> isPart;
    for (const auto& cluster : clusters)
      isPart.push_back(
          isFragment(cluster, main) ||
          (cluster.count >= options_.minPoints && isFront(cluster, main, down)));
    std::optional<PlaneExtent> top;
    if (candidates_.rule.top())
      top = topExtent(*candidates_.rule.top(), candidates_.points, options_);
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < candidates_.points.size(); ++i)
      if (labels[i] == best || (isPart[static_cast<std::size_t>(labels[i])] &&
                                (!top || top->isWithin(candidates_.points[i], kEndSlack))))
        out.push_back(i);
    return out;
  }

 private:
  /** Is a cell at the rim of the range, with the same surface going on outside? */
  bool goesOn(const ObjectCloud::Cell& cell) const
  {
    constexpr int kReach = 2;  // cells
    const auto outside = [&](int at, int first, int end)
    {
      if (at < first + candidates_.step) return first - kReach;
      return at >= end - candidates_.step ? end - 1 + kReach : at;
    };
    const auto& range = candidates_.range;
    const int c = outside(cell.c, range.c0, range.c1), r = outside(cell.r, range.r0, range.r1);
    if (range.contains(c, r) || !cloud_.inside(c, r) || !cloud_.valid(c, r)) return false;
    const double z = cloud_.depth(cell.c, cell.r);
    if (std::abs(cloud_.depth(c, r) - z) >
        options_.clusterTolerance + kBeyondChance * options_.depthSigma(z))
      return false;
    return !task_.support ||
           planes_.plane(*task_.support).plane.signedDistance(cloud_.point(c, r).cast<double>()) >
               supportTolerance(z, task_.label, options_);
  }

  const DepthCloud& cloud_;
  const ScenePlanes& planes_;
  const ObjectTask& task_;
  const BoxCandidates& candidates_;
  const PerceptionOptions& options_;
};

}  // namespace

std::optional<MainCluster> mainCluster(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ObjectTask& task,
    const BoxCandidates& candidates,
    const PerceptionOptions& options)
{
  const ClusterChoice choice(cloud, planes, task, candidates, options);
  const double range = median(sampleOf(candidates.points, 2)), gap = choice.gapAt(range);
  PointClusters parts(candidates.points, gap, options);
  if (candidates.step > 1) parts.join(steepNeighbours(cloud, candidates, gap));
  const auto clusters = choice.describe(parts);
  const int best = choice.bestOf(clusters);
  if (best < 0) return {};
  const Cluster& main = clusters[static_cast<std::size_t>(best)];
  MainCluster out;
  out.members = choice.membersOf(parts.labels(), clusters, best);
  out.fill = main.fill;
  out.leak = main.leak;
  out.rimGap = 2.0 * std::max(gap, 2.0 * options.depthSigma(range));
  return out;
}

}  // namespace quadmap
