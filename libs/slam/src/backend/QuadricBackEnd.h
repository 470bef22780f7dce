#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <deque>
#include <map>
#include <vector>

#include "BackEnd.h"
#include "OdometryChain.h"
#include "quadmap/graph/FactorGraph.h"
#include "quadmap/quadric/QuadricObjects.h"

namespace quadmap
{
/** QuadricSLAM (Nicholson, Milford, Suenderhauf, RA-L 2019): poses and ellipsoids from box edges
 * and odometry alone; no depth is looked at. The baseline that the rgbd method is compared with.
 *
 * While running, the latest keyframes are estimated with the objects seen from them. At the end
 * everything is, in turn with the associations; the objects of that estimation are the map's. */
class QuadricBackEnd : public BackEnd
{
 public:
  /** \param correctPoses False: poses are taken as given.
   *  \param labels Must outlive this object. */
  QuadricBackEnd(
      const JointOptions& options,
      const CQuadricObjectMap::TInsertionOptions& mapOptions,
      bool correctPoses,
      const LabelTable& labels);

  mrpt::poses::CPose3D addKeyframe(
      const mrpt::poses::CPose3D& T_odom_robot,
      const std::optional<mrpt::poses::CPose3DPDFGaussian>& step,
      const CObservationObjects* boxes,
      SlamResult& result) override;
  void finish(const BoxesOf& boxesOf, SlamResult& result) override;

 private:
  using Decisions = std::vector<CQuadricObjectMap::Decision>;

  Decisions associate(
      const CObservationObjects& boxes,
      std::size_t keyframe,
      const Eigen::Matrix<double, 6, 6>& poseCovariance,
      const QuadricObjects::PoseOf& poseOf);
  /** Everything that is known of an object and not yet in the graph. */
  void addToWindow(ObjectId id, std::size_t keyframe, bool isNew);
  BoxMeasurement viewFor(
      const BoxView& view, const mrpt::poses::CPose3D& T_map_robot, const Ellipsoid& object) const;

  /** One round of association and optimisation.
   *  \return The farthest that a keyframe moved [m]. */
  double round(const BoxesOf& boxesOf, SlamResult& result);
  FactorGraph globalGraph(const SlamResult& result) const;
  void fillMap(SlamResult& result) const;

  JointOptions options_;
  CQuadricObjectMap::TInsertionOptions mapOptions_;
  bool correctPoses_;
  const LabelTable& labels_;
  FactorGraph graph_;
  QuadricObjects objects_;
  OdometryMotion odometry_;
  std::map<ObjectId, std::deque<Eigen::Vector3d>> cameras_;  //!< Latest places it was seen from
};

}  // namespace quadmap
