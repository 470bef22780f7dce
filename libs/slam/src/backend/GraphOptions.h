#pragma once

#include "quadmap/graph/FactorGraph.h"
#include "quadmap/slam/JointOptions.h"

namespace quadmap
{
/** Which poses a back end's graph has. */
enum class GraphScope
{
  Window,   //!< While running: it looks at its latest poses alone and forgets what is folded
  WholeRun  //!< At the end
};

inline FactorGraphOptions graphOptions(
    const JointOptions& options, const EstimatorOptions& estimator, GraphScope scope)
{
  FactorGraphOptions graph;
  graph.estimator = estimator;
  graph.maxIterations = options.maxIterations;
  graph.floorSigma = options.floorSigma;
  graph.keepsFolded = scope == GraphScope::WholeRun;
  return graph;
}

}  // namespace quadmap
