#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "OdometryDrift.h"
#include "quadmap/graph/FactorGraph.h"

namespace quadmap
{
/** How far a run may have drifted between keyframes by all that its graph knows:
 * doc/mathematics.md, (16.26). The moves of a keyframe's pose move all that it sees.
 *
 * Heights drift as by the odometry alone. What a robot that has drifted takes for the floor and for
 * up is wrong, and holds its poses where they are. */
class ViewedDrift : public Drift
{
 public:
  /** \param graph Its pose k is that of keyframe k.
   * \param keyframes All that covariance() may be asked for, each once.
   * \param shouldStop Asked for each keyframe.
   * \return Nothing when the graph does not join each pose to pose 0 (FactorGraph::jointMarginal),
   * or after a yes to shouldStop(). */
  static std::optional<ViewedDrift> of(
      FactorGraph& graph,
      const std::vector<std::size_t>& keyframes,
      const OdometryDrift& odometry,
      const std::function<bool()>& shouldStop);

  Eigen::Matrix3d covariance(const Moved& a, const Moved& b) const override;

 private:
  explicit ViewedDrift(const OdometryDrift& odometry) : odometry_(odometry) {}

  struct Pose
  {
    Eigen::Vector3d position;  // [m]
    Eigen::Index row = 0;      // of its increments in joint_
  };
  OdometryDrift odometry_;
  std::map<std::size_t, Pose> poses_;  // by keyframe
  Eigen::MatrixXd joint_;              // covariance of the increments of all
};

}  // namespace quadmap
