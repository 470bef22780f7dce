#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/slam/PoseUncertainty.h"

namespace quadmap
{
/** A pose graph as the odometry of a recording: the text format of mrpt::graphs::CNetworkOfPoses3D,
 * map z-up.
 *
 * Nodes: the comment `# TIME id seconds` says at which time the robot was at node `id`; a node may
 * have several times. A graph without any is taken for one node per image: those numbered one after
 * the other from the first on and joined by edges. Other nodes are landmarks and left out.
 *
 * Poses are the nodes', so that what closed loops did to them is kept; the edge between a pose and
 * the next says how uncertain the step is. */
class GraphOdometry
{
 public:
  /** \exception std::runtime_error With one line, the file's name first: cannot be read, is no
   *  graph, or an information matrix is not positive definite. */
  explicit GraphOdometry(const std::string& path);

  /** T_map_robot of the next image of the recording; nothing when no node has its time.
   *  \param time [s].
   *  \exception std::runtime_error More images than nodes, and no times. */
  std::optional<mrpt::poses::CPose3D> poseAt(double time);

  /** Motion from the image of the last call of this method to the latest image with a pose; nothing
   *  at the first call.
   *  \param options Of steps that no edge speaks of. */
  std::optional<mrpt::poses::CPose3DPDFGaussian> takeStep(const PoseUncertaintyOptions& options);

  /** To be called after the last image.
   *  \exception std::runtime_error Fewer images than nodes, and no times. */
  void requireAllUsed() const;

  const std::string& path() const { return path_; }

 private:
  using Covariance = mrpt::math::CMatrixDouble66;
  struct Pose
  {
    mrpt::poses::CPose3D T_map_robot;
    std::optional<Covariance> stepCovariance;  //!< Of the step to the next
  };
  mrpt::poses::CPose3DPDFGaussian step(
      std::size_t from, std::size_t to, const PoseUncertaintyOptions& options) const;

  std::string path_;
  std::vector<Pose> poses_;              //!< Of the robot, in the order of time
  std::map<double, std::size_t> times_;  //!< [s] to index of the pose
  std::size_t images_ = 0;               //!< That asked for their pose
  std::optional<std::size_t> latest_, keyframe_;
};

}  // namespace quadmap
