#pragma once

#include <optional>
#include <vector>

#include "cloud/BoxCandidates.h"
#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
/** The candidates of a box that are its object. */
struct MainCluster
{
  std::vector<std::size_t> members;  //!< Indices of candidates
  double fill = 0;                   //!< IoU of the bounds of its main part with the box
  double leak = 0;    //!< Share of the box's outline across which the surface goes on outside
  double rimGap = 0;  //!< Neighbours of a member that are no farther in depth belong to it, too [m]
};

/** Divides the candidates of a box into clusters and takes the best one, with the parts that join
 * it (doc/mathematics.md, 7, "Clusters"). Nothing is returned when no cluster is large enough. */
std::optional<MainCluster> mainCluster(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ObjectTask& task,
    const BoxCandidates& candidates,
    const PerceptionOptions& options);

}  // namespace quadmap
