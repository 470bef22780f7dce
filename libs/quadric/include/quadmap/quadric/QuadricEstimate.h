#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <vector>

#include "quadmap/maps/MapOptions.h"
#include "quadmap/quadric/BoxView.h"

namespace quadmap
{
/** Of a free object's steps (d [m], w [rad], d ln s), see GraphState.h. */
using QuadricCovariance = Eigen::Matrix<double, 9, 9>;

/** A label as this method knows it: boxes touch the ellipsoid, whatever the thing's shape. */
LabelProperties withEllipsoidOutline(LabelProperties label);

/** A box and the pose it was seen from. */
struct PosedView
{
  const BoxView* view = nullptr;
  mrpt::poses::CPose3D T_map_robot;
};

struct QuadricEstimate
{
  Ellipsoid object;
  QuadricCovariance covariance = QuadricCovariance::Identity();
  double cost = 0;  //!< Half the sum of squared residuals, robust
};

/** The ellipsoid that the edges of all boxes touch best, from a first guess, at fixed poses. */
QuadricEstimate estimateQuadric(
    const std::vector<PosedView>& views,
    const Ellipsoid& start,
    const LabelProperties& label,
    const InsertionOptions& options);

/** A thing of the label's usual size at the distance at which it fills the box, upright, its longer
 * side across the view. */
Ellipsoid usualObjectIn(
    const BoxView& view, const mrpt::poses::CPose3D& T_map_robot, const LabelProperties& label);

/** log of how much better the object explains the edges of a box than anything in the image does;
 * -infinity when the object is not in front of the camera.
 * \param poseCovariance Of steps of the robot's pose (GraphState.h). */
double boxLogLikelihoodRatio(
    const PosedView& seen,
    const Ellipsoid& object,
    const QuadricCovariance& covariance,
    const Eigen::Matrix<double, 6, 6>& poseCovariance,
    const InsertionOptions& options);

}  // namespace quadmap
