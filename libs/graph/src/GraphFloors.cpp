#include <algorithm>
#include <cmath>

#include "GraphProblem.h"
#include "quadmap/geometry/CuboidExtent.h"
#include "quadmap/geometry/RobustStatistics.h"

// Things that stand on one floor: (16.8) and (16.10) to (16.12) of doc/mathematics.md.
namespace quadmap
{
namespace
{
/** Standard deviation that all bottoms on one floor have in common [m]: floors are not even, and
 * the supporting plane is fitted to what shows of it. */
constexpr double kUneven = 0.03;

}  // namespace

double bottomInformation(const BoxMeasurement& view)
{
  const FaceMeasurement& bottom = view.faces.back();
  return isEquality(bottom.kind) ? view.weight / (bottom.sigma * bottom.sigma) : 0.0;
}

HeightDrift GraphProblem::heightDrift() const
{
  HeightDrift drift;
  for (std::size_t k = firstView_; k < graph_.poses_.size(); ++k)
  {
    std::optional<mrpt::poses::CPose3DPDFGaussian> fromLast;
    for (const auto& step : graph_.stepsByPose_[k])
      if (k > 0 && step.from == k - 1) fromLast = step.believed(graph_.stepNoise_);
    drift.add(
        Eigen::Map<const Eigen::Vector2d>(graph_.poses_[k].data() + 4),
        fromLast ? &*fromLast : nullptr);
  }
  return drift;
}

StandingThing GraphProblem::standingThing(ObjectId id) const
{
  const auto& object = graph_.objects_.at(id);
  const Ellipsoid solid = objectOf(object.block, object.freedom);
  StandingThing thing;
  thing.bottom = cuboidBottom(solid);
  thing.place = solid.center().head<2>();
  // A bottom that nobody saw is anywhere within the height of the thing: a uniform distribution.
  double information = 12 / std::pow(object.label.typicalSize.z(), 2);
  if (object.prior) information += object.prior->L(2, 2);
  if (folded_) information += object.foldedBottom;
  for (const auto& [pose, view] : views_.at(id))
  {
    information += bottomInformation(*view);
    thing.poses.push_back(pose - firstView_);
  }
  const double sigma = graph_.options_.floorSigma;
  thing.variance = 1 / information + kUneven * kUneven + sigma * sigma;  // (16.10)
  return thing;
}

/** The known floor nearest to a height, or a new one. */
double* GraphProblem::floorBlock(double height)
{
  double* best = nullptr;
  double least = 3 * kUneven;
  for (double& known : graph_.floorHeights_)
  {
    if (std::find(floors_.begin(), floors_.end(), &known) != floors_.end()) continue;
    if (const double apart = std::abs(known - height); apart < least)
    {
      least = apart;
      best = &known;
    }
  }
  return best ? best : &graph_.floorHeights_.emplace_back(height);
}

void GraphProblem::addFloors()
{
  if (graph_.options_.floorSigma <= 0) return;
  std::vector<ObjectId> standing;
  std::vector<StandingThing> things;
  for (const auto& [id, block] : objects_)
    if (graph_.objects_.at(id).label.support == UsualSupport::Floor && views_.count(id) != 0)
    {
      standing.push_back(id);
      things.push_back(standingThing(id));
    }
  const auto floors = floorsOf(things, heightDrift());
  std::vector<std::vector<double>> bottoms(things.size());
  for (std::size_t i = 0; i < things.size(); ++i) bottoms[floors[i]].push_back(things[i].bottom);
  for (std::size_t i = 0; i < things.size() && !bottoms[i].empty(); ++i)
    floors_.push_back(floorBlock(median(bottoms[i])));
  for (std::size_t i = 0; i < things.size(); ++i)
    problem_.AddResidualBlock(
        createFloorFactor(
            graph_.options_.floorSigma, graph_.options_.estimator.huber,
            graph_.objects_.at(standing[i]).freedom)
            .release(),
        nullptr, objects_.at(standing[i]), floors_[floors[i]]);
}

}  // namespace quadmap
