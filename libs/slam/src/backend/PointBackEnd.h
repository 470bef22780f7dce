#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <optional>
#include <vector>

#include "BackEnd.h"
#include "OdometryChain.h"
#include "quadmap/estimation/ObjectView.h"
#include "quadmap/points/PointSlam.h"

namespace quadmap
{
/** The baseline whose objects are points: the centres of the measurements, associated and estimated
 * together with the poses by PointSlam. The map gets the estimated centres, the median of the
 * measured sizes, and no orientation. */
class PointBackEnd : public BackEnd
{
 public:
  /** \param correctPoses False: poses are taken as given. \param labels Must outlive it. */
  PointBackEnd(const SlamConfiguration& configuration, bool correctPoses, const LabelTable& labels);

  mrpt::poses::CPose3D addKeyframe(
      const mrpt::poses::CPose3D& T_odom_robot,
      const std::optional<mrpt::poses::CPose3DPDFGaussian>& step,
      const CObservationObjects* boxes,
      SlamResult& result) override;
  void finish(const BoxesOf& boxesOf, SlamResult& result) override;

 private:
  /** A measurement that was handed on. */
  struct Seen
  {
    std::size_t box = 0;
    bool complete = false;
    Eigen::Vector3d halfSizes;  //!< The horizontal ones in order [m]; partial: typical ones
    mrpt::Clock::time_point time;
  };

  std::vector<PointMeasurement<3>> measure(
      const CObservationObjects& boxes, const mrpt::poses::CPose3D& T_map_robot);
  void noteDecisions(const PointResult<3>& found, SlamResult& result) const;
  void fillMap(
      const PointResult<3>& found,
      const mrpt::poses::CPose3D& T_map_graph,
      SlamResult& result) const;
  MapObject mapObjectOf(
      const PointObject<3>& object,
      const std::vector<Seen>& seen,
      const mrpt::poses::CPose3D& T_map_graph) const;

  bool correctPoses_ = true;
  bool associationGiven_ = false;
  double centerSigma_ = 0;  //!< [m]
  const LabelTable& labels_;
  PointSlam<3> slam_;
  std::vector<std::vector<Seen>> seen_;  //!< By keyframe and measurement
  OdometryMotion odometry_;
};

}  // namespace quadmap
