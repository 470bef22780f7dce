#include "quadmap/slam/quadric/QuadricEstimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../backend/ViewRedundancy.h"
#include "quadmap/geometry/Support.h"
#include "quadmap/maps/Association.h"
#include "quadmap/slam/graph/FactorGraph.h"

namespace quadmap
{
namespace
{
using Eigen::Vector3d;

/** A thing without a plausible distance is looked for in a room [m]. */
constexpr double kNearest = 0.3, kFarthest = 8.0;

/** Distance at which a size fills the angle between two planes that face each other [m]. */
double rangeOf(double size, const Plane& a, const Plane& b)
{
  const double angle = std::acos(std::clamp(-a.n.dot(b.n), -1.0, 1.0));
  return std::clamp(0.5 * size / std::tan(0.5 * angle), kNearest, kFarthest);
}

/** Distance of an edge from touching the object [m], with its derivatives by steps. */
struct EdgeGap
{
  double r;
  Eigen::Matrix<double, 1, 9> d_object;
  Eigen::Matrix<double, 1, 6> d_pose;
};

EdgeGap edgeGap(const Plane& edge, const Ellipsoid& object, const Vector3d& robot)
{
  const Eigen::Matrix3d R = object.rotation();
  const auto width = supportWithDerivatives(R.transpose() * edge.n, object.semiAxes(), 2.0);
  const Vector3d gradient = R * width.d_n;  // by the normal
  EdgeGap gap;
  gap.r = edge.signedDistance(object.center()) - width.h;
  gap.d_object << edge.n.transpose(), edge.n.cross(gradient).transpose(),
      -width.d_s.cwiseProduct(object.semiAxes()).transpose();
  // A turn of the robot about its own origin turns the normal and carries the camera along.
  gap.d_pose << edge.n.cross(object.center() - robot - gradient).transpose(), -edge.n.transpose();
  return gap;
}

}  // namespace

LabelProperties withEllipsoidOutline(LabelProperties label)
{
  label.shapeExponent = 2.0;
  return label;
}

QuadricEstimate estimateQuadric(
    const std::vector<PosedView>& views,
    const Ellipsoid& start,
    const LabelProperties& label,
    const InsertionOptions& options)
{
  constexpr ObjectId kId = 1;
  FactorGraphOptions graphOptions;
  graphOptions.estimator = options.estimator;
  graphOptions.floorSigma = 0;
  FactorGraph graph(graphOptions);
  graph.setObject(kId, start, withEllipsoidOutline(label), ObjectFreedom::Free);

  std::vector<Vector3d> cameras;
  for (const auto& seen : views) cameras.push_back(seen.view->placedAt(seen.T_map_robot).camera);
  const auto shares = independentShares(cameras, start.center(), options.existence);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    RobotView view =
        views[i].view->robotView(views[i].T_map_robot, start, options.poseNoise, options.estimator);
    view.weight = shares[i];
    graph.addView(graph.addPose(views[i].T_map_robot), kId, view);
  }
  QuadricEstimate estimate;
  estimate.cost = graph.optimiseObjects().finalCost;
  estimate.object = graph.object(kId);
  estimate.covariance = graph.objectMarginals().at(kId);
  return estimate;
}

Ellipsoid usualObjectIn(
    const BoxView& view, const mrpt::poses::CPose3D& T_map_robot, const LabelProperties& label)
{
  const PlacedBox box = view.placedAt(T_map_robot);
  const Vector3d size = label.typicalSize;
  const double across = rangeOf(std::sqrt(size.x() * size.y()), box.edges[0], box.edges[2]);
  const double upright = rangeOf(size.z(), box.edges[1], box.edges[3]);
  const bool acrossSeen = box.usable[0] && box.usable[2],
             uprightSeen = box.usable[1] && box.usable[3];
  const double range = acrossSeen == uprightSeen ? std::sqrt(across * upright)
                       : acrossSeen              ? across
                                                 : upright;
  const Vector3d ahead = box.forward(), center = box.camera + range * ahead;
  // The longer horizontal side across the view.
  const double yaw = std::atan2(ahead.y(), ahead.x()) + (size.x() > size.y() ? M_PI / 2 : 0);
  return {mrpt::poses::CPose3D(center.x(), center.y(), center.z(), yaw, 0, 0), 0.5 * size};
}

double boxLogLikelihoodRatio(
    const PosedView& seen,
    const Ellipsoid& object,
    const QuadricCovariance& covariance,
    const Eigen::Matrix<double, 6, 6>& poseCovariance,
    const InsertionOptions& options)
{
  const PlacedBox box = seen.view->placedAt(seen.T_map_robot);
  const Vector3d robot(seen.T_map_robot.x(), seen.T_map_robot.y(), seen.T_map_robot.z());
  const double range = box.forward().dot(object.center() - box.camera);
  if (range < object.semiAxes().minCoeff()) return -std::numeric_limits<double>::infinity();
  const double shape = kOutlineSpread * object.semiAxes().mean();

  const auto rows = static_cast<Eigen::Index>(seen.view->usableEdges());
  Eigen::VectorXd r(rows);
  Eigen::MatrixXd J_object(rows, 9), J_pose(rows, 6);
  Eigen::VectorXd variances(rows);
  double log = 0;
  Eigen::Index row = 0;
  for (std::size_t e = 0; e < box.edges.size(); ++e)
  {
    const EdgeGap gap = edgeGap(box.edges[e], object, robot);
    const double angle = std::hypot(seen.view->edges[e].angleSigma, options.poseNoise.angle);
    const double variance = std::pow(range * angle, 2) + std::pow(options.poseNoise.position, 2) +
                            std::pow(options.estimator.edgeFloor, 2) + shape * shape;
    if (box.usable[e])
    {
      r[row] = gap.r;
      J_object.row(row) = gap.d_object;
      J_pose.row(row) = gap.d_pose;
      variances[row++] = variance;
      // The density of an edge that may be anywhere in the image.
      log += std::log(range * seen.view->fieldOfView);
    }
    else if (gap.r > 0)  // a cut edge: the object goes at least as far
    {
      const double all = variance + (gap.d_object * covariance * gap.d_object.transpose()).value();
      log -= 0.5 * gap.r * gap.r / all;
    }
  }
  Eigen::MatrixXd S =
      J_object * covariance * J_object.transpose() + J_pose * poseCovariance * J_pose.transpose();
  S.diagonal() += variances;
  return log + logGaussian(r, S);
}

}  // namespace quadmap
