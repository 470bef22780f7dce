#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/obs/ObjectList.h"

namespace quadmap
{
/** Gives all spellings of one class the same name. */
using LabelFolding = std::function<std::string(const std::string&)>;

/** The installed label table's canonical names; without a table (and for labels it does not know)
 * lower case with ' ' for '_'. */
LabelFolding installedLabelFolding();

struct ObjectEvaluationOptions
{
  double maxCenterDistance = 0.3;  //!< A match is at most this far off [m]
  unsigned minFramesVisible = 3;   //!< Truth seen in fewer frames does not count as missed
  LabelFolding foldLabel = installedLabelFolding();
};

/** How alike a true and an estimated object are, given in one frame (doc/mathematics.md). */
struct ObjectComparison
{
  double centerDistance = 0;    //!< Trans [m]
  std::optional<double> angle;  //!< Rot [rad]: over the 24 relabelings; both orientations defined
  double shapeIoU = 0;          //!< After aligning centre and axes
  double iou3d = 0;             //!< Of the cuboids in place
};

/** Shape aligns the axes by the relabeling of the smallest rotation; when an orientation is not
 * defined, by the better of the two that keep the vertical (the truth's axis nearest to the
 * estimate's z). */
ObjectComparison compareObjects(const ObjectRecord& truth, const ObjectRecord& estimated);

struct ObjectMatch
{
  ObjectRecord truth, estimated;  //!< Both in the truth's world
  ObjectComparison comparison;
};

struct ObjectEvaluation
{
  std::vector<ObjectMatch> matches;     //!< In the order of the truth
  std::vector<ObjectRecord> missed;     //!< True objects nothing was estimated for
  std::vector<ObjectRecord> uncounted;  //!< The same, seen in too few frames to count
  std::vector<ObjectRecord> spurious;   //!< Estimated objects that are not there, truth's world

  std::size_t truthCount() const { return matches.size() + missed.size(); }
  std::size_t estimatedCount() const { return matches.size() + spurious.size(); }

  /** Nothing where it is not defined: no estimate, no truth, neither. */
  std::optional<double> precision() const, recall() const, f1() const;

  /** Means over the matches; nothing without one (for the angle: one with defined orientations). */
  std::optional<double> meanCenterDistance() const;  //!< [m]
  std::optional<double> meanAngle() const;           //!< [rad]
  std::optional<double> meanShapeIoU() const, meanIoU3d() const;
};

/** One-to-one assignment between objects of equal labels: as many pairs within maxCenterDistance as
 * possible, and of those assignments the one with the smallest sum of distances.
 * \param T_truth_estimated Carries the estimated objects into the truth's world. */
ObjectEvaluation evaluateObjects(
    const std::vector<ObjectRecord>& truth,
    const std::vector<ObjectRecord>& estimated,
    const mrpt::poses::CPose3D& T_truth_estimated,
    const ObjectEvaluationOptions& options = {});

}  // namespace quadmap
