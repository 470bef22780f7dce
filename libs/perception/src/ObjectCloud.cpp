#include "ObjectCloud.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "BoxCandidates.h"
#include "Cluster.h"
#include "LevelTop.h"
#include "ObjectRim.h"
#include "PointClusters.h"
#include "SupportRing.h"
#include "quadmap/geometry/RobustStatistics.h"

namespace quadmap
{
namespace
{
constexpr int kNobody = -1;
constexpr double kCentrality = 0.35;  // spread of the weights over the box, share of its size

double coverageOf(const DepthCloud& cloud, const ImageBox& box)
{
  const auto range = cloud.cellsOf(box);
  if (range.cells() == 0) return 0.0;
  int valid = 0;
  for (int r = range.r0; r < range.r1; ++r)
    for (int c = range.c0; c < range.c1; ++c) valid += cloud.valid(c, r) ? 1 : 0;
  return static_cast<double>(valid) / range.cells();
}

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

/** What was cut out of one box. */
struct Cut
{
  ObjectCloud object;
  double fill = 0;  // IoU of its main cluster's bounds and the box

  /** It fills its box and ends there: no part of anything else. */
  bool isSeparate() const
  {
    constexpr double kMinFill = 0.5, kMaxLeak = 0.1;
    return fill > kMinFill && object.leak < kMaxLeak;
  }
  double quality() const { return fill * (1.0 - object.leak); }
};

/** Cuts the objects of a frame out of their boxes. */
class Segmenter
{
 public:
  Segmenter(
      const DepthCloud& cloud,
      const ScenePlanes& planes,
      const std::vector<ObjectTask>& tasks,
      const PerceptionOptions& options) :
      cloud_(cloud), planes_(planes), tasks_(tasks), options_(options), candidates_(tasks.size())
  {
    owner_.assign(static_cast<std::size_t>(cloud.columns() * cloud.rows()), kNobody);
    for (std::size_t i = 0; i < tasks.size(); ++i)
      for (std::size_t j = 0; j < tasks.size(); ++j)
        isSameThing_.push_back(i == j || showOneThing(boxOf(i), boxOf(j)));
  }

  /** Small boxes first: what stands alone in one of them is no part of the larger ones around it.
   * Where two of the others took the same thing, the one that it suits less gets what is left. */
  std::vector<ObjectCloud> run()
  {
    std::vector<Cut> cuts(tasks_.size());
    std::vector<std::size_t> order(tasks_.size()), unsure;
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(
        order.begin(), order.end(),
        [&](auto a, auto b) { return boxOf(a).area() < boxOf(b).area(); });
    for (const std::size_t i : order)
    {
      cuts[i] = cutOut(i);
      if (cuts[i].isSeparate())
        claim(i, cuts[i].object);
      else
        unsure.push_back(i);
    }
    for (const std::size_t i : unsure)
    {
      for (const std::size_t j : unsure)
        if (tookThingOf(i, j, cuts)) claim(j, cuts[j].object);
      if (containsOthers(i, cuts[i].object)) cuts[i] = cutOut(i);
    }
    std::vector<ObjectCloud> out;
    for (auto& cut : cuts) out.push_back(std::move(cut.object));
    return out;
  }

 private:
  const ImageBox& boxOf(std::size_t i) const { return tasks_[i].detection->box; }
  int& owner(const ObjectCloud::Cell& cell)
  {
    return owner_[static_cast<std::size_t>(cell.r * cloud_.columns() + cell.c)];
  }

  /** Two boxes that a detector drew around one thing, under two names. */
  bool isSameThing(std::size_t i, std::size_t j) const
  {
    return isSameThing_[i * tasks_.size() + j];
  }
  bool belongsToOther(std::size_t i, const ObjectCloud::Cell& cell)
  {
    const int who = owner(cell);
    return who != kNobody && !isSameThing(i, static_cast<std::size_t>(who));
  }
  void claim(std::size_t i, const ObjectCloud& object)
  {
    object.mask.forEach(
        [&](int c, int r)
        {
          if (owner({c, r}) == kNobody) owner({c, r}) = static_cast<int>(i);
        });
  }

  /** Is what box i holds nearly all a part of what suits box j better? Not for a box within the
   * other: that may be a thing on a thing. */
  bool tookThingOf(std::size_t i, std::size_t j, const std::vector<Cut>& cuts) const
  {
    constexpr double kMinShare = 0.8, kMaxInside = 0.8;
    const ObjectCloud &mine = cuts[i].object, &theirs = cuts[j].object;
    if (isSameThing(i, j) || mine.empty() || cuts[j].quality() <= cuts[i].quality()) return false;
    const ImageBox &a = boxOf(i), &b = boxOf(j);
    const ImageBox both = {
        std::max(a.x1, b.x1), std::max(a.y1, b.y1), std::min(a.x2, b.x2), std::min(a.y2, b.y2)};
    if (both.area() == 0 || both.area() > kMaxInside * a.area()) return false;
    int all = 0, common = 0;
    mine.mask.forEach(
        [&](int c, int r)
        {
          ++all;
          common += theirs.mask.contains(c, r) ? 1 : 0;
        });
    return common > kMinShare * all;
  }
  bool containsOthers(std::size_t i, const ObjectCloud& object)
  {
    return std::any_of(
        object.cells.begin(), object.cells.end(),
        [&](const auto& cell) { return belongsToOther(i, cell); });
  }

  Cut cutOut(std::size_t index)
  {
    const ObjectTask& task = tasks_[index];
    Cut out;
    out.object.support = task.support;
    if (!boxOf(index).isValid()) return out;
    out.object.coverage = coverageOf(cloud_, boxOf(index));
    out.object.inBox = cloud_.cellsOf(boxOf(index));
    if (!candidates_[index])
      candidates_[index].emplace(candidatesIn(cloud_, planes_, task, options_));
    BoxCandidates& candidates = *candidates_[index];
    out.object.top = candidates.rule.top();
    keepOnly(
        candidates, [&](std::size_t i) { return !belongsToOther(index, candidates.cells[i]); });
    const int cellsPerPoint = candidates.step * candidates.step;
    if (static_cast<int>(candidates.points.size()) * cellsPerPoint < options_.minPoints) return out;

    const double range = median(sampleOf(candidates.points, 2)), gap = gapFor(boxOf(index), range);
    PointClusters parts(candidates.points, gap, options_);
    if (candidates.step > 1) parts.join(steepNeighbours(cloud_, candidates, gap));
    const auto clusters = describe(task, candidates, parts);
    const int best = bestOf(clusters);
    if (best < 0) return out;
    const Cluster& main = clusters[static_cast<std::size_t>(best)];
    out.fill = main.fill;
    out.object.leak = main.leak;
    out.object.step = candidates.step;
    for (const std::size_t i : membersOf(task, candidates, parts.labels(), clusters, best))
    {
      out.object.cells.push_back(candidates.cells[i]);
      out.object.points.push_back(candidates.points[i]);
    }
    addRim(
        candidates, 2.0 * std::max(gap, 2.0 * options_.depthSigma(range)),
        [&](const ObjectCloud::Cell& cell) { return !belongsToOther(index, cell); }, out.object);
    return out;
  }

  /** The candidates of the main cluster and of the parts that join it; nothing of a table but its
   * top reaches out over the rest: what stands beside its legs is a chair.
   * \param labels Of each candidate its cluster. */
  std::vector<std::size_t> membersOf(
      const ObjectTask& task,
      const BoxCandidates& candidates,
      const std::vector<int>& labels,
      const std::vector<Cluster>& clusters,
      int best) const
  {
    constexpr double kSlack = 0.05;  // [m]
    const Cluster& main = clusters[static_cast<std::size_t>(best)];
    const Eigen::Vector2d down = downInImage(cloud_.camera(), planes_.up, task.detection->box);
    std::vector<bool> isPart;
    for (const auto& cluster : clusters)
      isPart.push_back(
          isFragment(cluster, main) ||
          (cluster.count >= options_.minPoints && isFront(cluster, main, task.label, down)));
    std::optional<PlaneExtent> top;
    if (candidates.rule.top()) top = topExtent(*candidates.rule.top(), candidates.points, options_);
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < candidates.points.size(); ++i)
      if (labels[i] == best || (isPart[static_cast<std::size_t>(labels[i])] &&
                                (!top || top->isWithin(candidates.points[i], kSlack))))
        out.push_back(i);
    return out;
  }

  /** Gap that parts of one object may have: a share of its size, but no less than the sampling
   * needs. */
  double gapFor(const ImageBox& box, double range) const
  {
    const double size = std::sqrt(box.area()) * range / std::abs(cloud_.camera().fx);
    return std::max(
        options_.clusterToleranceGrowth * range,
        std::min(options_.clusterTolerance, options_.clusterToleranceShare * size));
  }

  std::vector<Cluster> describe(
      const ObjectTask& task, const BoxCandidates& candidates, const PointClusters& parts) const
  {
    const double s = cloud_.stride();
    const ImageBox target =
        task.detection->box.clipped(cloud_.camera().width, cloud_.camera().height);
    const auto& range = candidates.range;
    const auto columnWeights =
        gaussian(range.c0, range.c1, target.centerX() / s, kCentrality * target.width() / s);
    const auto rowWeights =
        gaussian(range.r0, range.r1, target.centerY() / s, kCentrality * target.height() / s);
    std::vector<Cluster> clusters(static_cast<std::size_t>(parts.count()));
    for (std::size_t i = 0; i < candidates.cells.size(); ++i)
    {
      const auto& cell = candidates.cells[i];
      auto& cluster = clusters[static_cast<std::size_t>(parts.labels()[i])];
      cluster.add(
          cell, candidates.points[i].z(),
          columnWeights[static_cast<std::size_t>(cell.c - range.c0)] *
              rowWeights[static_cast<std::size_t>(cell.r - range.r0)]);
      cluster.leaking += goesOn(task, candidates, cell);
    }
    const double outline = 2.0 * (range.c1 - range.c0 + range.r1 - range.r0) / candidates.step;
    for (auto& b : clusters)
    {
      b.count *= candidates.step * candidates.step;
      b.fill = imageBoxIoU({b.x1 * s, b.y1 * s, b.x2 * s, b.y2 * s}, target);
      b.leak = std::min(1.0, b.leaking / outline);
    }
    return clusters;
  }

  /** Is a cell at the rim of the range, with the same surface going on outside? */
  bool goesOn(
      const ObjectTask& task, const BoxCandidates& candidates, const ObjectCloud::Cell& cell) const
  {
    constexpr int kReach = 2;  // cells
    const auto outside = [&](int at, int first, int end)
    {
      if (at < first + candidates.step) return first - kReach;
      return at >= end - candidates.step ? end - 1 + kReach : at;
    };
    const auto& range = candidates.range;
    const int c = outside(cell.c, range.c0, range.c1), r = outside(cell.r, range.r0, range.r1);
    if (range.contains(c, r) || !cloud_.inside(c, r) || !cloud_.valid(c, r)) return false;
    const double z = cloud_.depth(cell.c, cell.r);
    if (std::abs(cloud_.depth(c, r) - z) > options_.clusterTolerance + 3.0 * options_.depthSigma(z))
      return false;
    return !task.support ||
           planes_.plane(*task.support).plane.signedDistance(cloud_.point(c, r).cast<double>()) >
               supportTolerance(z, task.label, options_);
  }

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

  const DepthCloud& cloud_;
  const ScenePlanes& planes_;
  const std::vector<ObjectTask>& tasks_;
  const PerceptionOptions& options_;
  std::vector<int> owner_;  // of each cell of the cloud: index of a task
  std::vector<std::optional<BoxCandidates>> candidates_;  // of each task, but others' cells
  std::vector<bool> isSameThing_;                         // of each pair of tasks
};

}  // namespace

std::vector<double> sampleOf(const std::vector<Eigen::Vector3d>& points, int axis)
{
  constexpr std::size_t kMost = 800;
  const std::size_t step = 1 + points.size() / kMost;
  std::vector<double> out;
  out.reserve(points.size() / step + 1);
  for (std::size_t i = 0; i < points.size(); i += step) out.push_back(points[i][axis]);
  return out;
}

std::vector<ObjectCloud> segmentObjects(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const std::vector<ObjectTask>& tasks,
    const PerceptionOptions& options)
{
  return Segmenter(cloud, planes, tasks, options).run();
}

}  // namespace quadmap
