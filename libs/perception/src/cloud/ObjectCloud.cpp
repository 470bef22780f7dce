#include "cloud/ObjectCloud.h"

#include <algorithm>
#include <numeric>

#include "cloud/BoxCandidates.h"
#include "cloud/MainCluster.h"
#include "cloud/ObjectRim.h"
#include "cloud/WallsBehind.h"

namespace quadmap
{
namespace
{
constexpr int kNobody = -1;

double coverageOf(const DepthCloud& cloud, const ImageBox& box)
{
  const auto range = cloud.cellsOf(box);
  if (range.cells() == 0) return 0.0;
  int valid = 0;
  for (int r = range.r0; r < range.r1; ++r)
    for (int c = range.c0; c < range.c1; ++c) valid += cloud.valid(c, r) ? 1 : 0;
  return static_cast<double>(valid) / range.cells();
}

/** What was cut out of one box (doc/mathematics.md, 7, "Several boxes"). */
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
   * Of the others the one that its points suit best comes first. */
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
    std::stable_sort(
        unsure.begin(), unsure.end(),
        [&](auto a, auto b) { return cuts[a].quality() > cuts[b].quality(); });
    for (const std::size_t i : unsure)
    {
      if (containsOthers(i, cuts[i].object)) cuts[i] = cutOut(i);
      claim(i, cuts[i].object);
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

  bool containsOthers(std::size_t i, const ObjectCloud& object)
  {
    return std::any_of(
        object.cells.begin(), object.cells.end(),
        [&](const auto& cell) { return belongsToOther(i, cell); });
  }

  /** Does the object stand on a surface that is no floor? */
  bool standsOnAThing(const ObjectTask& task) const
  {
    return task.support && !planes_.isFloor(*task.support);
  }

  /** Of what usually hangs on a wall, and stands on no table or shelf: the wall behind its box, and
   * how far before it it is. */
  std::optional<WallDistance> onWallOf(const ObjectTask& task, const ObjectCloud& object) const
  {
    if (task.label.support != UsualSupport::Wall || standsOnAThing(task)) return {};
    if (task.wall) return distanceFromWall(cloud_, object.inBox, planes_.plane(*task.wall).plane);
    const auto wall = wallAround(cloud_, planes_, object.box, options_);
    if (!wall) return {};
    auto out = distanceFromWall(cloud_, object.inBox, wall->plane);
    if (out) out->headingSigma = std::max(out->headingSigma, wall->headingSigma);
    return out;
  }

  Cut cutOut(std::size_t index)
  {
    const ObjectTask& task = tasks_[index];
    Cut out;
    out.object.support = task.support;
    if (!boxOf(index).isValid()) return out;
    out.object.coverage = coverageOf(cloud_, boxOf(index));
    out.object.box = boxOf(index);
    out.object.inBox = cloud_.cellsOf(boxOf(index));
    out.object.onWall = onWallOf(task, out.object);
    if (!candidates_[index])
      candidates_[index].emplace(candidatesIn(cloud_, planes_, task, options_));
    BoxCandidates& candidates = *candidates_[index];
    out.object.top = candidates.rule.top();
    keepOnly(
        candidates, [&](std::size_t i) { return !belongsToOther(index, candidates.cells[i]); });
    const int cellsPerPoint = candidates.step * candidates.step;
    if (static_cast<int>(candidates.points.size()) * cellsPerPoint < options_.minPoints) return out;

    const auto main = mainCluster(cloud_, planes_, task, candidates, options_);
    if (!main) return out;
    out.fill = main->fill;
    out.object.leak = main->leak;
    out.object.step = candidates.step;
    for (const std::size_t i : main->members)
    {
      out.object.cells.push_back(candidates.cells[i]);
      out.object.points.push_back(candidates.points[i]);
    }
    addRim(
        candidates, main->rimGap,
        [&](const ObjectCloud::Cell& cell) { return !belongsToOther(index, cell); }, out.object);
    return out;
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
