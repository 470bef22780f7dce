#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "cloud/ObjectCloud.h"
#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
/** Which cells of a box may belong to its object: those with depth (and in the mask), without the
 * supporting plane, what stands on its horizontal top, planes that reach far beyond the box and the
 * wall behind it. */
class CandidateRule
{
 public:
  /** All references must outlive the rule.
   * \param range The cells of the enlarged box. */
  CandidateRule(
      const DepthCloud& cloud,
      const ScenePlanes& planes,
      const ObjectTask& task,
      const DepthCloud::CellRange& range,
      const PerceptionOptions& options);

  /** The point of a cell that may belong to the object. */
  std::optional<Eigen::Vector3d> candidate(int c, int r) const
  {
    if (!cloud_.valid(c, r) || cloud_.isFlyingPixel(c, r)) return {};
    const Eigen::Vector3d p = cloud_.point(c, r).cast<double>();
    if (isMaskedOut(c, r) || isBackground(c, r, p)) return {};
    return p;
  }

  float depth(int c, int r) const { return cloud_.depth(c, r); }  //!< Of a cell [m], 0 = none

  /** Vertical planes of the scene that reach beyond the box. */
  bool reachesBeyond(int plane) const { return reachesBeyond_[static_cast<std::size_t>(plane)]; }

  const std::optional<Plane>& top() const { return top_; }
  void setTop(const Plane& top) { top_ = top; }
  bool isAboveTop(const Eigen::Vector3d& p) const;
  void addWall(const Plane& wall) { walls_.push_back(wall); }

 private:
  bool isMaskedOut(int c, int r) const;
  bool isBackground(int c, int r, const Eigen::Vector3d& p) const;

  const DepthCloud& cloud_;
  const ScenePlanes& planes_;
  const ObjectTask& task_;
  const PerceptionOptions& options_;
  const Plane* support_ = nullptr;
  std::optional<Plane> top_;
  std::vector<bool> reachesBeyond_;  // of each plane of the scene
  std::vector<Plane> walls_;         // behind the box
};

/** The cells of a detector's box that may belong to its object. */
struct BoxCandidates
{
  CandidateRule rule;
  DepthCloud::CellRange range;  //!< Where was looked: the enlarged box
  int step = 1;                 //!< Of large boxes every step-th row and column
  std::vector<ObjectCloud::Cell> cells = {};
  std::vector<Eigen::Vector3d> points = {};  //!< Of these cells, optical frame [m]
};

/** Drops the candidates for which `keep(index)` is false. */
template <typename Keep>
void keepOnly(BoxCandidates& candidates, const Keep& keep)
{
  std::size_t kept = 0;
  for (std::size_t i = 0; i < candidates.cells.size(); ++i)
  {
    if (!keep(i)) continue;
    candidates.cells[kept] = candidates.cells[i];
    candidates.points[kept++] = candidates.points[i];
  }
  candidates.cells.resize(kept);
  candidates.points.resize(kept);
}

BoxCandidates candidatesIn(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ObjectTask& task,
    const PerceptionOptions& options);

}  // namespace quadmap
