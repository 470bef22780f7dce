#pragma once

#include <Eigen/Dense>
#include <deque>
#include <optional>

#include "quadmap/estimation/EstimatorOptions.h"
#include "quadmap/estimation/MapObject.h"
#include "quadmap/estimation/ObjectView.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** Quadratic knowledge about a state: cost = 1/2 x^T L x - xi^T x. */
struct InformationPrior
{
  UprightCovariance L = UprightCovariance::Zero();
  UprightState xi = UprightState::Zero();
  unsigned complete = 0, yawDefined = 0;  //!< Measurements behind it

  bool empty() const { return L.isZero(0.0); }
  /** The state with its yaw in that full turn in which it agrees best with what is known: a yaw
   * means the same every turn. */
  UprightState inItsTurn(const UprightState& x) const;
};

class ObjectEvidence;

/** Fuses the measurements of one object: state (x, y, z, yaw, ln a, ln b, ln c) in the map. */
class ObjectEstimator
{
 public:
  struct Estimate
  {
    UprightState state = UprightState::Zero();
    UprightCovariance covariance = UprightCovariance::Identity();
    double cost = 0;  //!< Half the sum of squared residuals, robust
    bool orientationDefined = false;
    bool isRound = false;  //!< Its sides are where those of a round thing are, whatever its label
  };

  /** Keeps the measurement. When there are too many, the one goes that was seen from nearly the
   * same place as a newer one. */
  void add(ObjectView view, const EstimatorOptions& options);

  /** The most probable state. \param start First guess, also tried from the measurements' medians
   *  when `restart` is set, unless the poses are final; without one the medians are used.
   *  \exception std::logic_error If there is neither a start nor a measurement. */
  Estimate estimate(
      const std::optional<UprightState>& start,
      const LabelProperties& label,
      const EstimatorOptions& options,
      bool restart = false) const;

  /** What an estimate errs by in case those measurements are right that saw the object reach
   * farther, (11.25) of doc/mathematics.md. estimate() leaves it out: the likelier case is that
   * they are wrong. */
  UprightCovariance contradictions(
      const UprightState& at, const LabelProperties& label, const EstimatorOptions& options) const;

  /** What an estimate errs by because no image shows where the object ends, (11.27). estimate()
   * leaves it out, and gives the most probable ends. Nothing when a file knew the object: what that
   * claims holds it already. */
  UprightCovariance openEnds(
      const UprightState& at, const LabelProperties& label, const EstimatorOptions& options) const;

  /** Takes over everything another estimator of the same object knows, but for redundant
   * measurements beyond the limit.
   *  \param here, there The states of this and of the other one; axes are matched between them. */
  void absorb(
      const ObjectEstimator& other,
      const UprightState& here,
      const UprightState& there,
      const EstimatorOptions& options);

  /** Tells what the measurements have in common, because the poses they were taken from err alike:
   * a covariance that estimate() adds, however many measurements there are. */
  void setSharedError(const UprightCovariance& error) { sharedError_ = error; }
  const UprightCovariance& sharedError() const { return sharedError_; }

  /** Everything as one prior, linearised at a state: what a file keeps.
   * \param doubts What else the state may err by. */
  InformationPrior summary(
      const UprightState& at,
      const LabelProperties& label,
      const EstimatorOptions& options,
      const UprightCovariance& doubts = UprightCovariance::Zero()) const;
  static ObjectEstimator fromSummary(const InformationPrior& prior);

  /** An estimator whose estimate(), started there, returns this state, and this covariance unless
   * the label's prior alone is more certain. \param estimate `cost` is not looked at. */
  static ObjectEstimator fromEstimate(
      const Estimate& estimate, const LabelProperties& label, const EstimatorOptions& options);

  /** The change of a state by which what a file knew would be satisfied best, were that linear. It
   * is small for the states and the summaries that one map wrote together. */
  UprightState pullOfSummary(
      const UprightState& at, const LabelProperties& label, const EstimatorOptions& options) const;

  /** Says that the poses of the measurements are no longer in doubt, until the next measurement:
   * sides and edges that contradict the rest let go then, (11.28). Else it may be a pose that is
   * wrong, and has to be found by them. \return Whether this may change what estimate() gives. */
  bool setPosesFinal();

  /** How summary(), contradictions() and openEnds() take the object; estimate() finds out. */
  void setRound(bool isRound) { isRound_ = isRound; }

  const std::deque<ObjectView>& views() const { return views_; }

  /** Does it hold what was known before its measurements, from a file or from fromEstimate()? */
  bool hasPrior() const { return !prior_.empty(); }

 private:
  ObjectEvidence evidenceAt(
      const UprightState& at, const LabelProperties& label, const EstimatorOptions& options) const;
  void limitViews(const EstimatorOptions& options);

  std::deque<ObjectView> views_;
  InformationPrior prior_;
  bool isRound_ = false, posesAreFinal_ = false;
  UprightCovariance sharedError_ = UprightCovariance::Zero();
};

/** Robust first guess: the median of where the measurements have each face; of partial measurements
 * alone the mean position and the label's typical size. Nothing without views. */
std::optional<UprightState> medianState(
    const std::deque<ObjectView>& views, const LabelProperties& label);

}  // namespace quadmap
