#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "quadmap/obs/ObjectList.h"

namespace quadmap
{
/** Gives all spellings of a label the same name. */
using LabelSpelling = std::function<std::string(const std::string&)>;

/** The canonical names of the installed label table. Without a table, and for labels that it lacks,
 * the name is in lower case with ' ' in place of '_'. */
LabelSpelling installedLabelSpelling();

struct ObjectEvaluationOptions
{
  double maxCenterDistance = 0.3;  //!< Largest distance of a match [m]
  unsigned minFramesVisible = 3;   //!< True objects seen in fewer frames are not missed
  LabelSpelling canonicalLabel = installedLabelSpelling();
};

/** How alike a true and an estimated object are. Both are in one frame. The figures are
 * doc/mathematics.md, (20.3) to (20.6). */
struct ObjectComparison
{
  double centerDistance = 0;    //!< Trans [m]
  std::optional<double> angle;  //!< Rot [rad]; empty when an orientation is not defined
  double shapeIoU = 0;          //!< Shape, in [0, 1]
  double iou3d = 0;             //!< 3-D IoU, in [0, 1]
  /** Squared errors over what the covariance claims, (20.8); 3, 1 and 1 are expected. They are
   * empty without a covariance, that of the yaw also where an orientation is not defined. */
  std::optional<double> centerNees, heightNees, yawNees;
};

/** Compares a true and an estimated object. Shape takes the relabeling of the axes that has the
 * smallest rotation. When an orientation is not defined, it takes the better of the two relabelings
 * that bring the truth's axis nearest to the estimate's z onto it. */
ObjectComparison compareObjects(const ObjectRecord& truth, const ObjectRecord& estimated);

struct ObjectMatch
{
  ObjectRecord truth, estimated;  //!< Both are in the truth's world
  ObjectComparison comparison;
};

struct ObjectEvaluation
{
  std::vector<ObjectMatch> matches;     //!< In the order of the truth
  std::vector<ObjectRecord> missed;     //!< True objects without an estimated one
  std::vector<ObjectRecord> uncounted;  //!< Missed ones that were in too few frames to count
  std::vector<ObjectRecord> spurious;   //!< Estimated objects without a true one, truth's world

  std::size_t truthCount() const { return matches.size() + missed.size(); }
  std::size_t estimatedCount() const { return matches.size() + spurious.size(); }

  /** doc/mathematics.md, (20.7). A figure is empty when its denominator is zero. */
  std::optional<double> precision() const, recall() const, f1() const;

  /** Means over the matches that have the figure; empty when no match has it. */
  std::optional<double> meanCenterDistance() const;  //!< [m]
  std::optional<double> meanAngle() const;           //!< [rad]
  std::optional<double> meanShapeIoU() const, meanIoU3d() const;
  std::optional<double> meanCenterNees() const, meanHeightNees() const, meanYawNees() const;
};

/** Objects that cannot be compared in any reasonable time. */
struct TooManyObjects : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** Assigns true and estimated objects of equal labels one to one. The assignment has as many pairs
 * within maxCenterDistance as possible and, with that many, the smallest sum of distances.
 * \param T_truth_estimated Carries the estimated objects into the truth's world.
 * \exception TooManyObjects For more than 1,000 of either kind. */
ObjectEvaluation evaluateObjects(
    const std::vector<ObjectRecord>& truth,
    const std::vector<ObjectRecord>& estimated,
    const mrpt::poses::CPose3D& T_truth_estimated,
    const ObjectEvaluationOptions& options = {});

}  // namespace quadmap
