#include <gtest/gtest.h>

#include <cmath>

#include "../../surfaces/SyntheticFrame.h"
#include "quadmap/geometry/RotationDistance.h"
#include "quadmap/perception/FramePerception.h"

namespace quadmap
{
namespace
{
constexpr double kHeight = 0.73;
const Eigen::Vector3d kTableSize(0.9, 1.3, kHeight);

/** A table of a thin top, box 0, on legs, seen from above. Its own pixels make its box.
 * \param yaw [rad] \param y To the left [m]. */
SyntheticFrame table(double yaw, double y)
{
  SyntheticFrame frame(1.6, 0.6);
  frame.noise = 0.0015;
  constexpr double kThick = 0.03, kLeg = 0.06, kX = 1.9;
  frame.add(kX, y, kHeight - kThick, yaw, {kTableSize.x(), kTableSize.y(), kThick});
  for (const double along : {-0.4, 0.4})
    for (const double across : {-0.6, 0.6})
      frame.add(
          kX + std::cos(yaw) * along - std::sin(yaw) * across,
          y + std::sin(yaw) * along + std::cos(yaw) * across, 0, yaw,
          {kLeg, kLeg, kHeight - kThick});
  return frame;
}

CompleteMeasurement measured(const SyntheticFrame& frame, const std::string& label)
{
  static const LabelTable labels = LabelTable::installed();
  CObservationObjects boxes = frame.observation({frame.detect(0, label)});
  FramePerception(PerceptionOptions(), labels).measure(frame.scan(), boxes, frame.up_sensor());
  const auto& m = boxes.objects.front().measurement;
  EXPECT_TRUE(m.complete) << m.reason;
  return m.complete.value_or(CompleteMeasurement());
}

/** Calls visit(face, error) for the four sides: how far each is outside of the true one [m]. */
template <typename Visit>
void forEachSide(
    const SyntheticFrame& frame, const CompleteMeasurement& m, double yaw, const Visit& visit)
{
  const Ellipsoid world = m.object_sensor.transformed(frame.T_world_sensor);
  const Eigen::Vector3d center = frame.boxes[0].cuboid.center();
  const Eigen::Vector2d x(std::cos(yaw), std::sin(yaw)), y(-x.y(), x.x());
  for (std::size_t f = 0; f < 4; ++f)
  {
    const auto axis = static_cast<Eigen::Index>(f / 2);
    const Eigen::Vector2d n = (f % 2 == 0 ? 1.0 : -1.0) * world.rotation().col(axis).head<2>();
    const double half =
        0.5 * (std::abs(n.dot(x)) > std::abs(n.dot(y)) ? kTableSize.x() : kTableSize.y());
    const double reach = n.dot((world.center() - center).head<2>()) + world.semiAxes()[axis];
    visit(m.faces[f], n, reach - half);
  }
}
}  // namespace

TEST(TopRim, OfATableSeenFromAboveGivesHeadingAndSides)
{
  for (const double yaw : {-0.3, 0.1, 0.5})
  {
    const SyntheticFrame frame = table(yaw, 0.0);
    const auto m = measured(frame, "dining table");
    ASSERT_TRUE(m.yawDefined) << yaw;
    const Ellipsoid world = m.object_sensor.transformed(frame.T_world_sensor);
    const auto turned =
        symmetricRotationDistance(frame.boxes[0].cuboid.rotation(), world.rotation());
    EXPECT_LT(turned.angle, 0.02) << yaw;
    forEachSide(
        frame, m, yaw,
        [&](const FaceMeasurement& face, const Eigen::Vector2d& n, double error)
        {
          EXPECT_EQ(face.kind, FaceKind::Measured) << yaw << ", " << n.transpose();
          // A cell of the far side is 4 cm long on the top.
          EXPECT_LT(std::abs(error), 0.02) << yaw << ", " << n.transpose();
        });
  }
}

TEST(TopRim, SaysAtLeastWhereTheImageCutsTheTop)
{
  const SyntheticFrame frame = table(0.1, 1.0);  // reaches beyond the left border of the image
  const auto m = measured(frame, "dining table");
  int cut = 0;
  forEachSide(
      frame, m, 0.1,
      [&](const FaceMeasurement& face, const Eigen::Vector2d& n, double error)
      {
        if (n.y() < 0.9) return;
        ++cut;
        EXPECT_EQ(face.kind, FaceKind::AtLeast);
        EXPECT_LT(error, -0.1) << "it is larger than what shows";
      });
  EXPECT_EQ(cut, 1);
}

TEST(TopRim, DoesNotEndWhereSomethingOnTheTableHidesIt)
{
  SyntheticFrame frame = table(0.1, 0.0);
  frame.add(1.62, 0.0, kHeight, 0.1, {0.1, 1.2, 0.4});  // a screen before the far half
  const auto m = measured(frame, "dining table");
  int far = 0;
  forEachSide(
      frame, m, 0.1,
      [&](const FaceMeasurement& face, const Eigen::Vector2d& n, double error)
      {
        if (n.x() < 0.9) return;
        ++far;
        EXPECT_TRUE(face.kind != FaceKind::Measured || std::abs(error) < 0.03) << error;
      });
  EXPECT_EQ(far, 1);
}

}  // namespace quadmap
