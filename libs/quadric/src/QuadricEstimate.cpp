#include "quadmap/quadric/QuadricEstimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "quadmap/estimation/Association.h"
#include "quadmap/estimation/ResidualRow.h"
#include "quadmap/estimation/ViewRedundancy.h"
#include "quadmap/geometry/PosePosition.h"
#include "quadmap/geometry/ViewAngles.h"
#include "quadmap/graph/FactorGraph.h"

namespace quadmap
{
namespace
{
using Eigen::Vector3d;

/** Bounds of the distance of a thing: it is looked for in a room [m]. */
constexpr double kNearest = 0.3, kFarthest = 8.0;

/** Distance at which a size fills a box from edge to edge, in a room [m]: doc/mathematics.md,
 * (17.6).
 */
double rangeOf(double size, const Plane& a, const Plane& b)
{
  return std::clamp(rangeThatFills(size, a.n, b.n), kNearest, kFarthest);
}

/** Residual of an edge with its derivatives by object and pose, doc/mathematics.md, (3.5), (3.6)
 * and (16.3). */
TangencyRow edgeRow(const Plane& edge, const ObjectShape& object, const Vector3d& robot)
{
  TangencyRow row = tangencyRow(edge.n, edge.signedDistance(object.t), object, 2.0);
  addPoseDerivatives(edge.n, object.t - robot, row);
  return row;
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
    BoxMeasurement view = views[i].view->measurementFor(
        views[i].T_map_robot, start, options.poseNoise, options.estimator);
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
  const Vector3d robot = positionOf(seen.T_map_robot);
  const double range = box.forward().dot(object.center() - box.camera);
  if (range < object.semiAxes().minCoeff()) return -std::numeric_limits<double>::infinity();
  const ObjectShape shape(object.center(), object.rotation(), object.semiAxes());
  const double outline = kOutlineSpread * object.semiAxes().mean();

  const auto rows = static_cast<Eigen::Index>(seen.view->usableEdges());
  Eigen::VectorXd r(rows);
  Eigen::MatrixXd J_object(rows, 9), J_pose(rows, 6);
  Eigen::VectorXd variances(rows);
  double log = 0;
  Eigen::Index row = 0;
  for (std::size_t e = 0; e < box.edges.size(); ++e)
  {
    const TangencyRow gap = edgeRow(box.edges[e], shape, robot);
    const double angle = std::hypot(seen.view->edges[e].angleSigma, options.poseNoise.angle);
    const double variance =  // (17.1)
        std::pow(range * angle, 2) + std::pow(options.poseNoise.position, 2) +
        std::pow(options.estimator.edgeFloor, 2) + outline * outline;
    if (box.usable[e])
    {
      r[row] = gap.r;
      J_object.row(row) = gap.byFreeObject();
      J_pose.row(row) = gap.byPose();
      variances[row++] = variance;
      // The density of an edge that may be anywhere in the image, (17.4).
      log += std::log(range * seen.view->fieldOfView);
    }
    else if (gap.r > 0)  // (17.5): an object goes at least as far as the cut edge
    {
      const double all =
          variance + (gap.byFreeObject() * covariance * gap.byFreeObject().transpose()).value();
      log -= 0.5 * gap.r * gap.r / all;
    }
  }
  Eigen::MatrixXd S =  // (17.3)
      J_object * covariance * J_object.transpose() + J_pose * poseCovariance * J_pose.transpose();
  S.diagonal() += variances;
  return log + logGaussian(r, S);
}

}  // namespace quadmap
