#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "quadmap/estimation/NormalEquations.h"
#include "quadmap/estimation/RepeatedErrors.h"
#include "quadmap/estimation/ViewAtPose.h"
#include "quadmap/maps/ObjectEstimator.h"

namespace quadmap
{
/** Adds what a file knew, doc/mathematics.md, (11.19). */
void addPrior(const InformationPrior& prior, const UprightState& state, NormalEquations& eq);

/** The measured part of the cost (doc/mathematics.md, (11.1)): views with their weights, and what a
 * file knew. */
class ObjectEvidence
{
 public:
  /** \param reference The weights of the views are taken there. \param prior, options Must outlive
   * it, as must the views. \param shapeExponent Of the label; nothing when the object is round.
   * \param fade See RowKernels. */
  ObjectEvidence(
      const std::deque<ObjectView>& views,
      const InformationPrior& prior,
      const UprightState& reference,
      const EstimatorOptions& options,
      std::optional<double> shapeExponent,
      bool fade);

  NormalEquations at(const UprightState& x) const;
  /** Of all views with the same weight: how well a shape explains them must not depend on which of
   * them it has made little of. */
  double costOfEqualViews(const UprightState& x) const;
  /** What the views do not average out. */
  RepeatedErrors repeated(const UprightState& x) const;

 private:
  const std::deque<ObjectView>& views_;
  const InformationPrior& prior_;
  const EstimatorOptions& options_;
  double shapeExponent_;
  RowKernels kernels_;
  std::vector<BoxMeasurement> measurements_;
  std::vector<ViewAtPose> placed_;
};

}  // namespace quadmap
