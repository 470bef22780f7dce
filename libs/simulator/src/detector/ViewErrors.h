#pragma once

#include <Eigen/Dense>
#include <optional>

#include "quadmap/simulator/SimulatedDetector.h"

namespace quadmap::simulator
{
/** What a network gets wrong about one object as long as it sees it in the same way. */
struct ViewErrors
{
  bool isMissed = false, isMerged = false;
  bool hidesNeighbour = false;       //!< The neighbour in the same box has none of its own
  std::optional<double> wrongLabel;  //!< Which of the labels that it is mistaken for, in [0, 1)
  Eigen::Vector4d edges = Eigen::Vector4d::Zero();  //!< Of x1, y1, x2, y2, in sizes of the box
  Eigen::Vector4d cut = Eigen::Vector4d::Zero();    //!< Shares of width and height that are cut off
                                                    //!< at x1, y1, x2, y2
};

/** The errors of a view. They depend on nothing but the random seed, the object, and the cell of
 * directions and distances that it is seen from, so that frames may be made in any order.
 * \param eye Place of the camera in the frame of the object [m]. */
ViewErrors viewErrors(
    const DetectorOptions& options,
    std::uint64_t seed,
    std::size_t object,
    const Eigen::Vector3d& eye);

/** Whether there is anything to draw. */
bool hasViewErrors(const DetectorOptions& options);

}  // namespace quadmap::simulator
