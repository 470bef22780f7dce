#pragma once

#include <Eigen/Dense>
#include <map>
#include <vector>

#include "quadmap/estimation/EstimatorOptions.h"
#include "quadmap/estimation/MapObject.h"
#include "quadmap/estimation/ObjectView.h"
#include "quadmap/estimation/ViewAtPose.h"

namespace quadmap
{
/** Correlation of the own errors of two views of one side of an object, (11.21) of
 * doc/mathematics.md, in [0, 1]. \param a, b The cameras. \param center Of the object [m]. */
double repeatedShare(
    const Eigen::Vector3d& a,
    const Eigen::Vector3d& b,
    const Eigen::Vector3d& center,
    const EstimatorOptions& options);

/** Tells box edges how many others err alike: of n views of one side of an object, the shared part
 * of an edge's variance counts n times, so that together they know the side as well as one that
 * errs by it, doc/mathematics.md, (11.6). \param views Of one object, with their weights. */
void shareEdgeErrors(std::vector<BoxMeasurement>& views);

/** What many views of one object do not average out. They repeat errors: the same side is cut,
 * hidden, bent by the lens and drawn by the detector alike in all images from about one place, and
 * a little so from everywhere; and all depth of a sensor is too long or too short by one share. And
 * some views see the object reach farther than the estimate says, and may be right. */
class RepeatedErrors
{
 public:
  /** \param state Of the object, about which everything is linearised. \param fade See
   * RowKernels. */
  RepeatedErrors(
      const UprightState& state,
      double shapeExponent,
      const EstimatorOptions& options,
      bool fade = false);

  /** Takes one view. \param measurement Made of it, in the map. \param placed Made of that. */
  void add(const ObjectView& view, const BoxMeasurement& measurement, const ViewAtPose& placed);

  /** What the views' normal matrix H lacks for the errors that repeat: the estimate errs by
   * H^-1 + H^-1 X H^-1, (11.22) and (11.24). \return X, symmetric. */
  UprightCovariance crossTerms() const;

  /** What the estimate errs by in case those are right who see a side farther out, (11.25).
   * \return A covariance. */
  UprightCovariance contradictions() const;

  /** What the estimate errs by because no image shows where the object ends, (11.27).
   * \return A covariance. */
  UprightCovariance openEnds(const LabelProperties& label) const;

 private:
  struct Sigmas
  {
    double all, common;  // of a residual; of it what the pose adds and all edges of a side share

    double own2() const;
  };
  struct Row
  {
    Eigen::Vector4d place;   // of the camera
    UprightState influence;  // on the gradient, of an own error of one sigma
  };
  struct Side
  {
    std::vector<Row> rows;
    double found = 0, claimed = 0;  // of headings: sums of squared own errors
    double weights = 0;             // of all views of a face
    double squaredGaps = 0;         // of the faces that contradict, times their weights [m^2]
    double cut = 0, ends = 0;       // weights of the faces near by that the image cuts, and others

    double excess() const;  // by which headings scatter more than they claim, >= 1
  };

  UprightState moveOfSide(std::size_t face) const;
  void addFaces(
      const ObjectView& view,
      double weight,
      double common,
      const Eigen::Vector4d& place,
      const ViewAtPose& placed);
  static void addRow(
      const ResidualRow& row,
      const Sigmas& sigmas,
      const RobustKernel& kernel,
      double weight,
      const Eigen::Vector4d& place,
      Side& side);

  ObjectShape object_;
  double shapeExponent_;
  const EstimatorOptions& options_;
  RowKernels kernels_;
  std::map<int, Side> sides_;
  UprightState byDepth_ =
      UprightState::Zero();  // of the gradient, by a relative error of all depth
};

}  // namespace quadmap
