#include "quadmap/maps/ObjectEstimator.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "FreeInformation.h"
#include "LevenbergMarquardt.h"
#include "ObjectEvidence.h"
#include "quadmap/estimation/AxisRenaming.h"
#include "quadmap/estimation/LabelPrior.h"
#include "quadmap/geometry/RotationDistance.h"

namespace quadmap
{
namespace
{
/** Share of the complete measurements that must show a direction. */
constexpr double kYawShare = 0.25;

/** Complete measurements from which on what is round can be told from what has corners. */
constexpr double kFewComplete = 3;

/** The most probable state by that evidence, searched from one or two starts. */
ObjectEstimator::Estimate minimum(
    const ObjectEvidence& evidence,
    const UprightState& start,
    const std::optional<UprightState>& otherStart,
    const LabelProperties& label,
    const EstimatorOptions& options)
{
  const auto linearise = [&](const UprightState& x)
  {
    NormalEquations eq = evidence.at(x);
    addLabelPrior(x, label, options, eq);
    return eq;
  };
  UprightState x = start;
  NormalEquations best = minimise(linearise, x, options.maxIterations);
  if (otherStart)
  {
    UprightState other = *otherStart;
    other[3] = nearestEquivalentYaw(other[3], x[3], 2 * M_PI);
    const NormalEquations there = minimise(linearise, other, options.maxIterations);
    if (there.cost < best.cost)
    {
      best = there;
      x = other;
    }
  }
  ObjectEstimator::Estimate e;
  e.state = x;
  e.cost = best.cost;
  const UprightCovariance information = best.H + freeInformation();
  const UprightCovariance independent = information.ldlt().solve(UprightCovariance::Identity());
  const UprightCovariance repeated = evidence.repeated(x).crossTerms();
  e.covariance = independent + independent * repeated * independent;
  return e;
}

double labelCost(
    const UprightState& x, const LabelProperties& label, const EstimatorOptions& options)
{
  NormalEquations eq;
  addLabelPrior(x, label, options, eq);
  return eq.cost;
}

/** Index of the view that is missed least. It is the older one of the two whose cameras are nearest
 * to each other. */
std::ptrdiff_t mostRedundant(const std::deque<ObjectView>& views)
{
  std::size_t redundant = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < views.size(); ++i)
    for (std::size_t j = i + 1; j < views.size(); ++j)
    {
      const double distance = (views[i].camera - views[j].camera).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      redundant = i;
    }
  return static_cast<std::ptrdiff_t>(redundant);
}

}  // namespace

UprightState InformationPrior::inItsTurn(const UprightState& x) const
{
  constexpr double kTurn = 2 * M_PI;
  UprightState out = x;
  if (L(3, 3) > 0) out[3] -= kTurn * std::round((L * x - xi)[3] / L(3, 3) / kTurn);
  return out;
}

void ObjectEstimator::add(ObjectView view, const EstimatorOptions& options)
{
  views_.push_back(std::move(view));
  posesAreFinal_ = false;
  limitViews(options);
}

bool ObjectEstimator::setPosesFinal()
{
  const bool wereFinal = std::exchange(posesAreFinal_, true);
  return !wereFinal && !views_.empty();
}

void ObjectEstimator::limitViews(const EstimatorOptions& options)
{
  while (views_.size() > static_cast<std::size_t>(options.maxMeasurements))
    views_.erase(views_.begin() + mostRedundant(views_));
}

ObjectEstimator::Estimate ObjectEstimator::estimate(
    const std::optional<UprightState>& start,
    const LabelProperties& label,
    const EstimatorOptions& options,
    bool restart) const
{
  const auto medians = medianState(views_, label);
  if (!start && !medians) throw std::logic_error("ObjectEstimator: nothing to estimate from");
  // With a prior the medians of the measurements are not a consensus of all.
  const UprightState reference = medians && prior_.empty() ? *medians : start.value_or(*medians);
  const UprightState from = start.value_or(reference);
  // Where rows may let go, there are many minima: the search goes on from where it was.
  const auto other = restart && start && !posesAreFinal_ ? medians : std::nullopt;

  double complete = prior_.complete, defined = prior_.yawDefined;
  for (const auto& v : views_)
  {
    complete += v.complete ? 1 : 0;
    defined += v.complete && v.yawDefined ? 1 : 0;
  }
  const bool hasHeading = defined > 0 && defined >= kYawShare * complete;

  const ObjectEvidence angular(
      views_, prior_, reference, options, label.shapeExponent, posesAreFinal_);
  Estimate best = minimum(angular, from, other, label, options);
  if (label.dominantDirection && label.levelTop && !hasHeading && complete >= kFewComplete)
  {
    // Nothing told the yaw, and a start that is turned by half a right angle may stay there.
    for (const double turn : {M_PI / 8, M_PI / 4, 3 * M_PI / 8})
    {
      UprightState turned = best.state;
      turned[3] += turn;
      const Estimate there = minimum(angular, turned, std::nullopt, label, options);
      if (there.cost < best.cost) best = there;
    }
    const ObjectEvidence circular(views_, prior_, reference, options, std::nullopt, posesAreFinal_);
    const Estimate round = minimum(circular, from, other, label, options);
    const auto cost = [&](const ObjectEvidence& evidence, const Estimate& e)
    { return evidence.costOfEqualViews(e.state) + labelCost(e.state, label, options); };
    if (cost(circular, round) < cost(angular, best))
    {
      best = round;
      best.isRound = true;
    }
  }
  best.covariance += sharedError_;
  best.orientationDefined = label.dominantDirection && hasHeading;
  return best;
}

ObjectEvidence ObjectEstimator::evidenceAt(
    const UprightState& at, const LabelProperties& label, const EstimatorOptions& options) const
{
  return {
      views_,
      prior_,
      at,
      options,
      isRound_ ? std::nullopt : std::optional<double>(label.shapeExponent),
      posesAreFinal_};
}

UprightCovariance ObjectEstimator::contradictions(
    const UprightState& at, const LabelProperties& label, const EstimatorOptions& options) const
{
  return evidenceAt(at, label, options).repeated(at).contradictions();
}

UprightCovariance ObjectEstimator::openEnds(
    const UprightState& at, const LabelProperties& label, const EstimatorOptions& options) const
{
  if (!prior_.empty()) return UprightCovariance::Zero();  // a file may know ends that no view shows
  return evidenceAt(at, label, options).repeated(at).openEnds(label);
}

void ObjectEstimator::absorb(
    const ObjectEstimator& other,
    const UprightState& here,
    const UprightState& there,
    const EstimatorOptions& options)
{
  views_.insert(views_.begin(), other.views_.begin(), other.views_.end());
  posesAreFinal_ = posesAreFinal_ && other.posesAreFinal_;
  limitViews(options);
  const AxisRenaming r = axisRenaming(there, here);
  const UprightCovariance L = r.matrix(other.prior_.L);
  prior_.L += L;
  prior_.xi += r.P * other.prior_.xi + L * r.c;
  prior_.complete += other.prior_.complete;
  prior_.yawDefined += other.prior_.yawDefined;
  const UprightCovariance error = r.matrix(other.sharedError_);
  const auto ofCenter = [](const UprightCovariance& P) { return P.topLeftCorner<3, 3>().trace(); };
  if (ofCenter(error) > ofCenter(sharedError_)) sharedError_ = error;
}

InformationPrior ObjectEstimator::summary(
    const UprightState& at,
    const LabelProperties& label,
    const EstimatorOptions& options,
    const UprightCovariance& doubts) const
{
  constexpr double kLeast = 1e-9;  // of what nothing is known about
  const ObjectEvidence evidence = evidenceAt(at, label, options);
  const NormalEquations eq = evidence.at(at);
  InformationPrior all = prior_;
  // (H^-1 + H^-1 X H^-1 + S)^-1 = (1 + G S)^-1 G, G = H (H + X)^-1 H, also where H knows nothing in
  // some direction.
  const UprightCovariance repeated = evidence.repeated(at).crossTerms();
  UprightCovariance share = UprightCovariance::Identity();  // (H + X)^-1 H
  if (!repeated.isZero(0.0))  // what a file knew stays as it is, to the last bit
    share = (eq.H + repeated + kLeast * UprightCovariance::Identity()).ldlt().solve(eq.H);
  const Eigen::PartialPivLU<UprightCovariance> weaken(
      UprightCovariance::Identity() + eq.H * share * (sharedError_ + doubts));
  const UprightCovariance L = weaken.solve(UprightCovariance(eq.H * share));
  all.L = 0.5 * (L + L.transpose());
  all.xi = weaken.solve(UprightState(share.transpose() * (eq.H * at - eq.g)));
  for (const auto& v : views_)
  {
    all.complete += v.complete ? 1 : 0;
    all.yawDefined += v.complete && v.yawDefined ? 1 : 0;
  }
  return all;
}

UprightState ObjectEstimator::pullOfSummary(
    const UprightState& at, const LabelProperties& label, const EstimatorOptions& options) const
{
  NormalEquations eq;
  addPrior(prior_, at, eq);
  addLabelPrior(at, label, options, eq);
  return -UprightCovariance(eq.H + freeInformation()).ldlt().solve(eq.g);
}

ObjectEstimator ObjectEstimator::fromSummary(const InformationPrior& prior)
{
  ObjectEstimator e;
  e.prior_ = prior;
  return e;
}

ObjectEstimator ObjectEstimator::fromEstimate(
    const Estimate& estimate, const LabelProperties& label, const EstimatorOptions& options)
{
  NormalEquations eq;  // estimate() adds these by itself
  addLabelPrior(estimate.state, label, options, eq);
  InformationPrior rest;
  rest.L = withoutNegative(estimate.covariance.inverse() - eq.H - freeInformation());
  rest.xi = rest.L * estimate.state + eq.g;
  rest.complete = 1;
  rest.yawDefined = estimate.orientationDefined ? 1 : 0;
  return fromSummary(rest);
}

}  // namespace quadmap
