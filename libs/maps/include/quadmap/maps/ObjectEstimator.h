#pragma once

#include <Eigen/Dense>
#include <deque>
#include <optional>

#include "quadmap/maps/MapObject.h"
#include "quadmap/maps/ObjectView.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
struct EstimatorOptions
{
  int maxMeasurements = 150;  //!< Of one object that are kept; redundant ones go, >= 3
  int maxIterations = 25;     //!< Of the optimiser, >= 1
  /** Residuals beyond this many sigmas lose weight, lower bounds of sizes most of it, > 0. */
  double huber = 1.5;
  /** Added to the sigma of every box edge: this [m], >= 0, and that share of the mean half size,
   * >= 0, which the outline of a real thing is off that of an h_q. */
  double edgeFloor = 0.002;
  double edgeShapeShare = 0.03;
  bool edgesOfComplete =
      true;  //!< Use the box edges of complete measurements with unseen sides too
  double roundnessSigma = 0.1;   //!< Of ln(a/b) for labels without dominant direction [-], > 0
  double sizePriorSpread = 1.0;  //!< Factor on the label table's spread of sizes, > 0
  /** Of the seed of a partial measurement, (0, 1]. What is behind a thin or sparse object is taken
   * for it in most frames alike: ten seeds are worth one. */
  double seedWeight = 0.1;
};

/** Quadratic knowledge about a state: cost = 1/2 x^T L x - xi^T x. */
struct InformationPrior
{
  UprightCovariance L = UprightCovariance::Zero();
  UprightState xi = UprightState::Zero();
  unsigned complete = 0, yawDefined = 0;  //!< Measurements behind it

  bool empty() const { return L.isZero(0.0); }
};

/** Normal equations of a robust least-squares problem at one state: cost ~ 1/2 d^T H d + g^T d. */
struct NormalEquations
{
  UprightCovariance H = UprightCovariance::Zero();
  UprightState g = UprightState::Zero();
  double cost = 0;

  /** Adds one residual in sigmas with its derivatives, under Huber's kernel. */
  void add(double residual, const UprightState& jacobian, double huber, double weight = 1.0);

  /** Adds one residual under Cauchy's kernel: its pull fades with its distance. \param scale In
   * sigmas. */
  void addCauchy(double residual, const UprightState& jacobian, double scale, double weight = 1.0);
};

/** All residuals of one measurement: tangency of its faces and box edges, its yaw. The derivatives
 * are exact. \param weight Of the whole measurement. */
void addViewResiduals(
    const ObjectView& view,
    const UprightState& x,
    double shapeExponent,
    const EstimatorOptions& options,
    double weight,
    NormalEquations& eq);

/** Standard deviation of how far an object is from touching a box edge [m]. */
double edgeSigma(
    const ObjectView& view, const ObjectView::Edge& edge, const EstimatorOptions& options);

/** W such that W * (centre - seed) is in sigmas, [1/m]. \param covariance Of the seed [m^2]; W is
 * for the frame it is given in. */
Eigen::Matrix3d seedWhitening(const Eigen::Matrix3d& covariance, const EstimatorOptions& options);

/** How much a whole measurement is believed next to a reference state, in (0, 1]: near 1 when its
 * faces are where the reference has them, small for a wrong association or a bad cuboid. */
double viewWeight(const ObjectView& view, const UprightState& reference);

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
  };

  /** Keeps the measurement. When there are too many, the one goes that was seen from nearly the
   * same place as a newer one. */
  void add(ObjectView view, const EstimatorOptions& options);

  /** The most probable state. \param start First guess, also tried from the measurements' medians
   *  when `restart` is set; without one the medians are used.
   *  \exception std::logic_error If there is neither a start nor a measurement. */
  Estimate estimate(
      const std::optional<UprightState>& start,
      const LabelProperties& label,
      const EstimatorOptions& options,
      bool restart = false) const;

  /** Takes over everything another estimator of the same object knows.
   *  \param here, there The states of this and of the other one; axes are matched between them. */
  void absorb(const ObjectEstimator& other, const UprightState& here, const UprightState& there);

  /** Everything as one prior, linearised at a state: what a file keeps. */
  InformationPrior summary(
      const UprightState& at, const LabelProperties& label, const EstimatorOptions& options) const;
  static ObjectEstimator fromSummary(const InformationPrior& prior);

  /** Knows what another estimation found out: estimate() started there returns that state and, as
   *  far as the label's prior alone does not know more, that covariance. \param estimate `cost` is
   * not looked at. */
  static ObjectEstimator fromEstimate(
      const Estimate& estimate, const LabelProperties& label, const EstimatorOptions& options);

  const std::deque<ObjectView>& views() const { return views_; }

 private:
  std::deque<ObjectView> views_;
  InformationPrior prior_;
};

/** Robust first guess: the median of where the measurements have each face; of partial measurements
 * alone the mean position and the label's typical size. Nothing without views. */
std::optional<UprightState> medianState(
    const std::deque<ObjectView>& views, const LabelProperties& label);

}  // namespace quadmap
