#include "ObjectEvidence.h"

#include "quadmap/estimation/ObjectRules.h"
#include "quadmap/estimation/ViewResiduals.h"

namespace quadmap
{
void addPrior(const InformationPrior& prior, const UprightState& state, NormalEquations& eq)
{
  const UprightState x = prior.inItsTurn(state);
  eq.H += prior.L;
  eq.g += prior.L * x - prior.xi;
  eq.cost += 0.5 * x.dot(prior.L * x) - prior.xi.dot(x);
}

ObjectEvidence::ObjectEvidence(
    const std::deque<ObjectView>& views,
    const InformationPrior& prior,
    const UprightState& reference,
    const EstimatorOptions& options,
    std::optional<double> shapeExponent,
    bool fade) :
    views_(views),
    prior_(prior),
    options_(options),
    shapeExponent_(shapeExponent.value_or(kCylinder)),
    kernels_{options.huber, fade}
{
  measurements_.reserve(views.size());  // the placed ones refer to them
  placed_.reserve(views.size());
  for (ObjectView view : views)
  {
    if (!shapeExponent) view.faceExponent = kCircle;
    measurements_.push_back(measurementInMap(view, options));
    // A consensus needs a majority.
    measurements_.back().weight = views.size() < 3 ? 1.0 : viewWeight(view, reference);
  }
  shareEdgeErrors(measurements_);
  for (const BoxMeasurement& measurement : measurements_)
    placed_.emplace_back(
        measurement, RobotPose(), ObjectFreedom::Upright, RowDerivatives::OfObject);
}

NormalEquations ObjectEvidence::at(const UprightState& x) const
{
  NormalEquations eq;
  const ObjectShape object(x);
  for (std::size_t i = 0; i < placed_.size(); ++i)
    addViewResiduals(placed_[i], object, shapeExponent_, kernels_, measurements_[i].weight, eq);
  if (!prior_.empty()) addPrior(prior_, x, eq);
  return eq;
}

double ObjectEvidence::costOfEqualViews(const UprightState& x) const
{
  NormalEquations eq;
  for (const ViewAtPose& view : placed_)
    addViewResiduals(view, ObjectShape(x), shapeExponent_, kernels_, 1.0, eq);
  if (!prior_.empty()) addPrior(prior_, x, eq);
  return eq.cost;
}

RepeatedErrors ObjectEvidence::repeated(const UprightState& x) const
{
  RepeatedErrors errors(x, shapeExponent_, options_, kernels_.fade);
  for (std::size_t i = 0; i < placed_.size(); ++i)
    errors.add(views_[i], measurements_[i], placed_[i]);
  return errors;
}

}  // namespace quadmap
