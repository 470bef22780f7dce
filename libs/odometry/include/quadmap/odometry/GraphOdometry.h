#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/odometry/PoseUncertainty.h"

namespace quadmap
{
/** A pose graph that serves as the odometry of a recording. It has the text format of
 * mrpt::graphs::CNetworkOfPoses3D, and its map is z-up.
 *
 * The comment `# TIME id seconds` says at which time the robot was at node `id`. A node may have
 * several times. A graph without times must have one node per image: these are the nodes that are
 * numbered one after the other from the first on and joined by edges. Other nodes are landmarks and
 * are left out.
 *
 * The poses are those of the nodes, so that the corrections by closed loops are kept. The edge from
 * a pose to the next one says how uncertain the step is. */
class GraphOdometry
{
 public:
  /** \exception std::runtime_error If the file cannot be read, is no graph, has a node twice or an
   *  edge of a node that is not there, or an information matrix that is not positive definite. The
   * message is one line that starts with the file. */
  explicit GraphOdometry(const std::string& path);

  /** T_map_robot of the next image of the recording, or nothing when no node has its time.
   *  \param time Time of the image [s].
   *  \exception std::runtime_error If the graph has no times and fewer nodes than images. */
  std::optional<mrpt::poses::CPose3D> poseAt(double time);

  /** Motion from the image of the last call of this method to the latest image with a pose. The
   *  first call returns nothing.
   *  \param options Give the covariance of steps that have no edge. */
  std::optional<mrpt::poses::CPose3DPDFGaussian> takeStep(const PoseUncertaintyOptions& options);

  /** Call it after the last image.
   *  \exception std::runtime_error If the graph has no times and more nodes than images. */
  void requireAllUsed() const;

  /** Says how many poses have no image, and how many images are far outside the times of the poses;
   *  empty when there are none, and when no pose has an image. Call it after the last image. */
  std::string warning() const;

  const std::string& path() const { return path_; }

 private:
  using Covariance = mrpt::math::CMatrixDouble66;
  struct Pose
  {
    mrpt::poses::CPose3D T_map_robot;
    std::optional<Covariance> stepCovariance;  //!< Covariance of the step to the next pose
  };
  mrpt::poses::CPose3DPDFGaussian step(
      std::size_t from, std::size_t to, const PoseUncertaintyOptions& options) const;

  bool isFarOutside(double time) const;
  std::string warningOfMisfit() const;

  std::string path_;
  std::string warningOfCut_;             //!< See warningOfCut()
  std::vector<Pose> poses_;              //!< In the order of time
  std::vector<bool> wasUsed_;            //!< For each pose, whether an image has its time
  std::map<double, std::size_t> times_;  //!< From time [s] to index of the pose
  double longestGap_ = 0;                //!< Between two of these times [s]
  std::size_t images_ = 0;               //!< Number of images that asked for their pose
  std::size_t imagesOutside_ = 0;        //!< Of these, by more than poses are apart
  std::optional<std::size_t> latest_, keyframe_;
};

}  // namespace quadmap
