#include "LoopClosure.h"

#include <algorithm>

#include "MergedObjects.h"
#include "OdometryChain.h"
#include "SightedObjects.h"
#include "quadmap/graph/FactorGraph.h"

namespace quadmap
{
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
/** From a keyframe to a point that it saw. The point is a pose whose attitude nobody knows. */
CPose3DPDFGaussian stepToPoint(
    const CPose3D& T_map_robot, const Eigen::Vector3d& p_map, double sigma)
{
  constexpr double kAnyAngle = 100;  // [rad]
  CPose3DPDFGaussian step;
  const auto p = T_map_robot.inverseComposePoint({p_map.x(), p_map.y(), p_map.z()});
  step.mean = CPose3D(p.x, p.y, p.z, 0, 0, 0);
  for (int i = 0; i < 6; ++i) step.cov(i, i) = i < 3 ? sigma * sigma : kAnyAngle * kAnyAngle;
  return step;
}

}  // namespace

void bringTogether(
    const Doubles& doubles,
    const CQuadricObjectMap& map,
    double sigma,
    const StepNoise& noise,
    std::vector<Keyframe>& keyframes)
{
  FactorGraph graph{FactorGraphOptions()};
  graph.setStepNoise(noise);
  for (std::size_t k = 0; k < keyframes.size(); ++k)
  {
    graph.addPose(keyframes[k].T_map_robot);
    if (const auto& step = keyframes[k].odometryStep; step && k > 0)
      graph.addStep(k - 1, k, stiffAtRest(*step));
  }
  for (const auto& pair : doubles.pairs)
  {
    const Eigen::Vector3d before = comparedPoint(*map.find(pair.before)),
                          again = comparedPoint(*map.find(pair.again));
    const std::size_t i = pair.keyframeBefore, k = pair.keyframeAgain;
    const std::size_t point = graph.addPose(CPose3D(before.x(), before.y(), before.z(), 0, 0, 0));
    graph.addKnownStep(i, point, stepToPoint(keyframes[i].T_map_robot, before, sigma));
    graph.addKnownStep(k, point, stepToPoint(keyframes[k].T_map_robot, again, sigma));
  }
  graph.optimise();
  for (std::size_t k = 0; k < keyframes.size(); ++k) keyframes[k].T_map_robot = graph.pose(k);
}

bool becameOne(const Doubles& doubles, const SlamResult& before, const SlamResult& after)
{
  const auto heirs = heirsOf(before.decisions, after.decisions);
  const auto one = static_cast<std::size_t>(std::count_if(
      doubles.pairs.begin(), doubles.pairs.end(),
      [&](const Doubles::Pair& pair)
      {
        const auto a = heirs.find(pair.before), b = heirs.find(pair.again);
        return a != heirs.end() && b != heirs.end() && a->second == b->second;
      }));
  return 2 * one > doubles.pairs.size() &&
         sightedObjects(after).size() + one <= sightedObjects(before).size();
}

}  // namespace quadmap
