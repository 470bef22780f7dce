// This file closes loops. JointBackEnd.cpp estimates.
#include <set>
#include <stdexcept>

#include "JointBackEnd.h"
#include "LoopClosure.h"
#include "OdometryDrift.h"
#include "SightedObjects.h"
#include "ViewedDrift.h"

namespace quadmap
{
void JointBackEnd::closeLoops(
    const BoxesOf& boxesOf, const std::function<bool()>& shouldStop, SlamResult& result)
{
  constexpr int kMost = 5;
  LoopSummary loops;
  while (loops.closed < kMost && !loops.open)
  {
    const StepNoise noise = result.correction->stepNoise.atLeastClaimed();
    const auto doubles = doublesOf(noise, boxesOf, shouldStop, result);
    loops.stopped = shouldStop();
    if (loops.stopped || !doubles) break;
    if (auto closed = closedLoop(*doubles, noise, boxesOf, result))
    {
      result = std::move(*closed);
      ++loops.closed;
    }
    else
      loops.open = LoopSummary::Open{doubles->pairs.size(), doubles->distance};
  }
  result.loops = loops;
}

std::optional<Doubles> JointBackEnd::doublesOf(
    const StepNoise& noise,
    const BoxesOf& boxesOf,
    const std::function<bool()>& shouldStop,
    const SlamResult& result) const
{
  // Most runs have nothing that odometry alone explains, and need no graph.
  const OdometryDrift odometry(result.keyframes, noise);
  const auto sighted = sightedObjects(result);
  const DoublesRules rules{sighted, labels_, places_};
  const auto candidates = doublesCandidates(rules, odometry);
  if (!findDoubles(rules, candidates, odometry, shouldStop)) return std::nullopt;
  FactorGraph graph =
      globalGraph(boxesOf, result, Priors(), FirstPose::Fixed, Returns::FindOtherObjects);
  graph.setStepNoise(noise);
  std::set<std::size_t> nearest;
  for (const auto& pair : candidates) nearest.insert({pair.before->nearest, pair.again->nearest});
  const auto drift = ViewedDrift::of(graph, {nearest.begin(), nearest.end()}, odometry, shouldStop);
  if (!drift) return std::nullopt;
  return findDoubles(rules, candidates, *drift, shouldStop);
}

std::optional<SlamResult> JointBackEnd::closedLoop(
    const Doubles& doubles,
    const StepNoise& noise,
    const BoxesOf& boxesOf,
    const SlamResult& result) const
{
  SlamResult closed = result;
  try
  {
    bringTogether(doubles, result.map, places_.positionSigma, noise, closed.keyframes);
    rebuildMap(boxesOf, closed);
    estimate([](const CQuadricObjectMap&) { return Priors(); }, boxesOf, closed);
  }
  catch (const std::runtime_error&)  // poses so bent that nothing can be estimated
  {
    return std::nullopt;
  }
  if (!becameOne(doubles, result, closed)) return std::nullopt;
  return closed;
}

}  // namespace quadmap
