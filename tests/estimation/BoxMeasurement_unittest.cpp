#include "quadmap/estimation/BoxMeasurement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

using namespace quadmap;
using Eigen::Vector3d;

namespace
{
/** A cuboid that is turned by 30 degrees, and one edge of its box.
 * \param n_obj Towards the object, in its frame. */
ObjectView viewWithEdge(const Vector3d& n_obj)
{
  ObjectView view;
  view.complete = true;
  view.camera = {-2, 0, 1};
  view.halfSizes = {0.3, 0.2, 0.5};
  view.yaw = M_PI / 6;
  const Eigen::AngleAxisd R(view.yaw, Vector3d::UnitZ());
  view.edges.push_back({Plane::throughPoint(R * n_obj.normalized(), view.camera), 0});
  for (auto& face : view.faces) face = {FaceKind::AtLeast, 0.02};
  return view;
}

double sharedBy(const ObjectView& view, const EstimatorOptions& options)
{
  return measurementInMap(view, options).edges.at(0).shared;
}

/** How far the surface of an ellipsoid reaches along a direction, by brute force. */
double reachOfEllipsoid(const Vector3d& n, const Vector3d& s)
{
  double reach = 0;
  for (double polar = 0; polar <= M_PI; polar += 0.01)
    for (double around = 0; around < 2 * M_PI; around += 0.01)
    {
      const Vector3d onSphere(
          std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar));
      reach = std::max(reach, n.dot(s.cwiseProduct(onSphere)));
    }
  return reach;
}

double reachOfCorners(const Vector3d& n, const Vector3d& s)
{
  double reach = 0;
  for (int corner = 0; corner < 8; ++corner)
    reach = std::max(
        reach, n.dot(s.cwiseProduct(
                   Vector3d(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1))));
  return reach;
}

}  // namespace

TEST(BoxMeasurement, AnEdgeOverCornersErrsByWhatAnOutlineMayBeThere)
{
  EstimatorOptions options;
  options.edgeShapeShare = 0;
  for (const Vector3d& n_obj : {Vector3d(0.5, 0.4, 0.77), Vector3d(-0.7, 0.1, 0.7)})
  {
    const Vector3d n = n_obj.normalized();
    const ObjectView view = viewWithEdge(n);
    // The standard deviation of what lies evenly between the two.
    const double between = reachOfCorners(n, view.halfSizes) - reachOfEllipsoid(n, view.halfSizes);
    EXPECT_NEAR(sharedBy(view, options), between / std::sqrt(12.0), 1e-4);
  }
}

TEST(BoxMeasurement, AnEdgeAlongAFaceErrsByHowBoxesAreDrawnAlone)
{
  const EstimatorOptions options;
  const ObjectView view = viewWithEdge(Vector3d::UnitY());
  EXPECT_NEAR(sharedBy(view, options), options.edgeShapeShare * view.halfSizes.mean(), 1e-4);
}

TEST(BoxMeasurement, NothingIsKnownOfTheCornersWithoutACuboid)
{
  const EstimatorOptions options;
  ObjectView view = viewWithEdge({1, 1, 1});
  view.complete = false;
  EXPECT_DOUBLE_EQ(sharedBy(view, options), options.edgeShapeShare * view.halfSizes.mean());
}

TEST(BoxMeasurement, SidesAreThoseOfTheMapHoweverTheRobotIsTurned)
{
  DetectedObject detected;
  detected.measurement.complete.emplace();
  for (const auto& [inward, side] :
       {std::pair(Vector3d(0, 0, -1), BoxSide::Upper), std::pair(Vector3d(0, 0, 1), BoxSide::Lower),
        std::pair(Vector3d(0, -1, 0), BoxSide::Left), std::pair(Vector3d(0, 1, 0), BoxSide::Right)})
  {
    ObjectView view = viewWithEdge(Vector3d::UnitX());
    view.center = {0, 0, 1};  // straight ahead, along the map's x
    view.edges.front().plane = Plane::throughPoint(inward, view.camera);
    EXPECT_EQ(measurementInMap(view, {}).edges.at(0).side, side);
    for (const double roll : {0.0, 0.5, 1.6, 3.0})
    {
      const mrpt::poses::CPose3D T_map_robot(1, 2, 3, 0.4, 0.2, roll);
      const auto m =
          measurementFromRobot(detected, view, T_map_robot, mrpt::poses::CPose3D(), {}, 0);
      EXPECT_EQ(m.edges.at(0).side, side) << "roll " << roll;
    }
  }
}
