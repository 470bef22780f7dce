// How long the factor graph takes: a keyframe of a long run (which must not grow with the run), and
// the final optimisation with its rounds of association. Prints tables; one core.

#include <cstdio>
#include <ctime>

#include "../graph/GraphWorld.h"
#include "quadmap/estimation/Association.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

namespace
{
double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

FactorGraphOptions options()
{
  FactorGraphOptions o;
  o.floorSigma = 0;
  return o;
}

/** 5,000 keyframes on a circle past 40 objects, each optimised in a window of 20. */
void longRun()
{
  GraphWorld::Size size;
  size.objects = 40;
  size.poses = 5000;
  size.circles = 50;
  size.radius = 6;
  GraphWorld world(1, size);
  FactorGraph graph(options());
  std::printf("keyframes      ms per keyframe   residuals   objects\n");
  double start = cpu_s();
  std::size_t residuals = 0;
  for (std::size_t k = 0; k < world.truth.size(); ++k)
  {
    const CPose3D guess = k == 0 ? world.odometry[0]
                                 : graph.pose(k - 1) + (world.odometry[k] - world.odometry[k - 1]);
    world.add(graph, k, guess);
    const auto summary = graph.optimiseWindow(k < 20 ? 1 : k - 19);
    graph.marginals(k < 20 ? 1 : k - 19, false);
    residuals += summary.residuals;
    if ((k + 1) % 500 != 0) continue;
    const double now = cpu_s();
    std::printf(
        "%4zu - %4zu %12.2f %17zu %9zu\n", k - 499, k, 2 * (now - start), residuals / 500,
        summary.freeObjects);
    start = now;
    residuals = 0;
  }
  std::printf(
      "trajectory error: %.3f m, odometry %.3f m\n\n",
      positionError(world.truth, [&](auto k) { return graph.pose(k); }),
      positionError(world.truth, [&](auto k) { return world.odometry[k]; }));
}

struct Measured
{
  std::size_t pose;
  std::size_t truth;  // index of the object
  BoxMeasurement view;
};

/** Every measurement joins the most probable object, frame by frame. */
std::vector<std::optional<ObjectId>> associate(
    FactorGraph& graph, const std::vector<Measured>& measured, std::size_t objects)
{
  std::vector<Eigen::Vector3d> centers;
  for (std::size_t i = 0; i < objects; ++i)
    centers.push_back(graph.object(static_cast<ObjectId>(i + 1)).center());
  const std::vector<AssociationTarget> targets(objects, {100, {{"thing", 100}}});
  const Eigen::Matrix3d S = Eigen::Matrix3d::Identity() * 0.05;
  std::vector<std::optional<ObjectId>> ids(measured.size());
  for (std::size_t first = 0; first < measured.size();)
  {
    std::size_t last = first;
    while (last < measured.size() && measured[last].pose == measured[first].pose) ++last;
    Eigen::MatrixXd log(last - first, objects);
    for (std::size_t k = first; k < last; ++k)
    {
      const auto& m = measured[k];
      const Ellipsoid seen = GraphWorld::placed(m.view, graph.pose(m.pose));
      for (std::size_t i = 0; i < objects; ++i)
        log(Eigen::Index(k - first), Eigen::Index(i)) = logGaussian(seen.center() - centers[i], S);
    }
    const std::vector<AssociationCandidate> candidates(last - first, {"thing", true});
    for (const auto& d : associateFrame(candidates, targets, {}, log))
      if (d.target) ids[first + d.measurement] = static_cast<ObjectId>(*d.target + 1);
    first = last;
  }
  return ids;
}

/** 1,000 keyframes and 100 objects. */
GraphWorld::Size largeWorld()
{
  GraphWorld::Size size;
  size.objects = 100;
  size.poses = 1000;
  size.circles = 3;
  size.radius = 12;
  size.maxRange = 12;
  size.stepAngle = 0.0005;
  return size;
}

/** 10,000 measurements. */
std::vector<Measured> measurementsOf(GraphWorld& world)
{
  std::vector<Measured> measured;
  for (std::size_t k = 0; k < world.truth.size(); ++k)
    for (std::size_t i = 0; i < world.objects.size(); ++i)
      if (world.visible(k, i) && (3 * i + k) % 40 < 27)
        measured.push_back({k, i, world.view(k, i)});
  return measured;
}

/** Poses and objects without measurements. */
void addWorld(
    FactorGraph& graph,
    const GraphWorld& world,
    const std::vector<CPose3D>& poses,
    const std::vector<std::optional<Ellipsoid>>& objects)
{
  for (std::size_t k = 0; k < poses.size(); ++k)
  {
    graph.addPose(poses[k]);
    if (k > 0)
      graph.addStep(k - 1, k, world.stepDistribution(world.odometry[k] - world.odometry[k - 1]));
  }
  for (std::size_t i = 0; i < objects.size(); ++i)
    graph.setObject(
        static_cast<ObjectId>(i + 1), objects[i].value_or(world.objects[i]), world.label());
}

void printMarginals(FactorGraph& graph)
{
  const double begin = cpu_s();
  const std::size_t objects = graph.marginals(0, true).objects.size();
  const double ofObjects = cpu_s();
  std::printf("marginals of %zu objects: %.2f s\n", objects, ofObjects - begin);
  const std::size_t poses = graph.poseMarginals().size(), edges = graph.graphEdges().size();
  std::printf(
      "marginals of %zu poses and %zu edges of the pose graph: %.2f s\n", poses, edges,
      cpu_s() - ofObjects);
}

/** Five rounds of association and optimisation. */
void finalRounds()
{
  GraphWorld world(2, largeWorld());
  const std::vector<Measured> measured = measurementsOf(world);
  std::vector<CPose3D> poses = world.odometry;
  std::vector<std::optional<Ellipsoid>> objects(world.objects.size());
  for (const auto& m : measured)
    if (!objects[m.truth]) objects[m.truth] = GraphWorld::placed(m.view, poses[m.pose]);

  std::printf(
      "%zu keyframes, %zu objects, %zu measurements\n", poses.size(), objects.size(),
      measured.size());
  std::printf("round   s association   s optimisation   iterations   wrong   error [m]\n");
  const double start = cpu_s();
  for (int round = 1; round <= 5; ++round)
  {
    FactorGraph graph(options());
    addWorld(graph, world, poses, objects);
    const double begin = cpu_s();
    const auto ids = associate(graph, measured, objects.size());
    std::size_t wrong = 0;
    for (std::size_t m = 0; m < measured.size(); ++m)
    {
      if (ids[m]) graph.addView(measured[m].pose, *ids[m], measured[m].view);
      wrong += ids[m] != static_cast<ObjectId>(measured[m].truth + 1) ? 1 : 0;
    }
    const double associated = cpu_s();
    const auto summary = graph.optimise();
    const double done = cpu_s();
    for (std::size_t k = 0; k < poses.size(); ++k) poses[k] = graph.pose(k);
    for (std::size_t i = 0; i < objects.size(); ++i)
      objects[i] = graph.object(static_cast<ObjectId>(i + 1));
    std::printf(
        "%5d %12.2f %16.2f %12d %7zu %11.3f\n", round, associated - begin, done - associated,
        summary.iterations, wrong, positionError(world.truth, [&](auto k) { return poses[k]; }));
    if (round == 5) printMarginals(graph);
  }
  std::printf(
      "total: %.2f s; odometry alone %.3f m\n", cpu_s() - start,
      positionError(world.truth, [&](auto k) { return world.odometry[k]; }));
}

}  // namespace

int main()
{
  longRun();
  finalRounds();
  return 0;
}
