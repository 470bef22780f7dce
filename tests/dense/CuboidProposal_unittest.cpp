#include "quadmap/dense/CuboidProposal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "ResultFolder.h"
#include "quadmap/geometry/Overlap.h"

using namespace quadmap;
using mrpt::poses::CPose3D;
using quadmap::testing::ResultFolder;

namespace
{
/** Points on the five upper sides of a cuboid on the floor, with cameras all around. */
ObjectPoints pointsOf(const Ellipsoid& cuboid, double noise)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::normal_distribution<double> normal(0, noise);
  ObjectPoints out;
  out.record.id = "4";
  out.record.label = "box";
  out.supportHeight = cuboid.center().z() - cuboid.semiAxes().z();
  for (int i = 0; i < 10000; ++i)
  {
    Eigen::Vector3d p(uniform(random), uniform(random), uniform(random));
    Eigen::Vector3d n = Eigen::Vector3d::Zero();
    const int side = i % 5;
    n[side / 2] = side % 2 == 0 ? 1 : -1;
    p[side / 2] = n[side / 2];
    p = p.cwiseProduct(cuboid.semiAxes()) + normal(random) * n;
    DensePoint point;
    point.position = (cuboid.center() + cuboid.rotation() * p).cast<float>();
    point.normal = (cuboid.rotation() * n).cast<float>();
    out.cloud.push_back(point);
  }
  for (int i = 0; i < 24; ++i)
    out.eyes.push_back(
        cuboid.center() +
        Eigen::Vector3d(3 * std::cos(i * M_PI / 12), 3 * std::sin(i * M_PI / 12), 1));
  out.boxesWithTop = 24;
  return out;
}

/** The largest distance of a side from that of the truth, for headings within 45 degrees [m]. */
double worstSide(const Ellipsoid& truth, const Ellipsoid& proposal)
{
  const Eigen::Matrix3d R = truth.rotation();
  const Eigen::Matrix<double, 3, 8> corners =
      R.transpose() * (proposal.cuboidCorners().colwise() - truth.center());
  const Eigen::Vector3d high = corners.rowwise().maxCoeff() - truth.semiAxes();
  const Eigen::Vector3d low = corners.rowwise().minCoeff() + truth.semiAxes();
  return std::max(high.cwiseAbs().maxCoeff(), low.cwiseAbs().maxCoeff());
}
}  // namespace

TEST(CuboidProposal, IsTheTightCuboidOfNoisyPointsWhateverItsHeading)
{
  for (const double yaw : {0.0, 0.3, 1.2, -2.5})
  {
    const Ellipsoid truth(CPose3D(1, 2, 0.4, yaw, 0, 0), {0.5, 0.3, 0.4});
    const auto proposal = proposeCuboid(pointsOf(truth, 0.002), {});
    ASSERT_TRUE(proposal);
    EXPECT_LT(worstSide(truth, proposal->record.object), 0.008) << yaw;
    EXPECT_GT(cuboidIoU(truth, proposal->record.object), 0.95) << yaw;
    EXPECT_TRUE(proposal->fullySeen());
    EXPECT_EQ(proposal->points, 10000u);
    EXPECT_EQ(proposal->record.id, "4");
    EXPECT_EQ(proposal->record.label, "box");
  }
}

TEST(CuboidProposal, OwesNothingToTheSizeInTheMap)
{
  const SyntheticRoom room;
  const ResultFolder result;
  const auto points = findObjectPoints(result.path(), {result.record()}, {}, [](double) {});
  const auto proposal = proposeCuboid(points.front(), {});
  ASSERT_TRUE(proposal);
  EXPECT_LT(worstSide(room.box, proposal->record.object), 0.01);
  EXPECT_TRUE(proposal->fullySeen());
}

TEST(CuboidProposal, TellsTheSidesThatNoCameraSaw)
{
  const Ellipsoid truth(CPose3D(0, 0, 0.4, 0, 0, 0), {0.5, 0.3, 0.4});
  ObjectPoints points = pointsOf(truth, 0);
  // Cameras where x is positive, and no points on the side -x.
  auto& eyes = points.eyes;
  eyes.erase(
      std::remove_if(eyes.begin(), eyes.end(), [](const auto& eye) { return eye.x() < 0.6; }),
      eyes.end());
  auto& cloud = points.cloud;
  cloud.erase(
      std::remove_if(
          cloud.begin(), cloud.end(), [](const auto& point) { return point.normal.x() < -0.5F; }),
      cloud.end());
  const auto proposal = proposeCuboid(points, {});
  ASSERT_TRUE(proposal);
  EXPECT_FALSE(proposal->fullySeen());
  const std::size_t hidden = proposal->record.object.rotation()(0, 0) > 0.9
                                 ? 1
                                 : (proposal->record.object.rotation()(0, 1) > 0.9 ? 3 : 2);
  EXPECT_FALSE(proposal->seen[hidden]);
  EXPECT_EQ(std::count(proposal->seen.begin(), proposal->seen.end(), true), 4);

  points.boxesWithTop = 0;
  EXPECT_FALSE(proposeCuboid(points, {})->seen[4]) << "no box ends at its top";
}

TEST(CuboidProposal, OfAFewPointsIsNone)
{
  ObjectPoints points = pointsOf(Ellipsoid(CPose3D(0, 0, 0.4, 0, 0, 0), {0.5, 0.3, 0.4}), 0);
  points.cloud.resize(10);
  EXPECT_FALSE(proposeCuboid(points, {}));
}

TEST(CuboidProposal, OfASheetIsThickEnoughForItsText)
{
  const Ellipsoid sheet(CPose3D(0, 0, 0.4, 0, 0, 0), {0.5, 0.00001, 0.4});
  const auto proposal = proposeCuboid(pointsOf(sheet, 0), {});
  ASSERT_TRUE(proposal);
  EXPECT_GE(proposal->record.object.semiAxes().minCoeff(), 0.001);
}

TEST(CuboidProposal, OfThingsWithoutHeadingIsAsNarrowAsCanBe)
{
  // A cup: a cylinder with a handle, whose rectangle of least area is a diagonal one.
  ObjectPoints cup;
  for (int i = 0; i < 4000; ++i)
  {
    const double angle = i * 0.01, z = (i % 40) * 0.0025;
    DensePoint point;
    point.position =
        Eigen::Vector3d(0.0425 * std::cos(angle), 0.0425 * std::sin(angle), z).cast<float>();
    cup.cloud.push_back(point);
    point.position = Eigen::Vector3d(0, 0.0425 + 0.024 * (i % 100) / 99, 0.05).cast<float>();
    if (i % 4 == 0) cup.cloud.push_back(point);
  }
  cup.record.orientationDefined = false;
  const auto narrow = proposeCuboid(cup, {});
  ASSERT_TRUE(narrow);
  Eigen::Vector2d sides = 2 * narrow->record.object.semiAxes().head<2>();
  if (sides.x() > sides.y()) std::swap(sides.x(), sides.y());
  EXPECT_NEAR(sides.x(), 0.085, 0.002);
  EXPECT_NEAR(sides.y(), 0.109, 0.002);
}

TEST(CuboidProposal, ThingsOnALevelTopAreNotTheObject)
{
  const Ellipsoid table(CPose3D(1, 2, 0.4, 0.3, 0, 0), {0.6, 0.4, 0.4});
  ObjectPoints points = pointsOf(table, 0.001);
  const Ellipsoid cup(CPose3D(1.1, 2.1, 0.86, 0, 0, 0), {0.04, 0.04, 0.06});
  for (const DensePoint& point : pointsOf(cup, 0.001).cloud) points.cloud.push_back(point);
  const double top = 0.8;
  const auto topOf = [](const CuboidProposal& proposal)
  { return proposal.record.object.center().z() + proposal.record.object.semiAxes().z(); };
  points.record.label = "dining table";
  const auto proposed = proposeCuboid(points, LabelTable::installed());
  ASSERT_TRUE(proposed);
  EXPECT_NEAR(topOf(*proposed), top, 0.008);
  EXPECT_TRUE(proposed->fullySeen());
  // What has no level top by its label may be so high, but that is not sure.
  points.record.label = "microwave";
  const auto unsure = proposeCuboid(points, LabelTable::installed());
  EXPECT_GT(topOf(*unsure), top + 0.1);
  EXPECT_FALSE(unsure->seen[4]);
  EXPECT_FALSE(unsure->fullySeen());
}

TEST(CuboidProposal, IsNotSureWhereOtherThingsTouch)
{
  const Ellipsoid truth(CPose3D(1, 2, 0.2, 0, 0, 0), {0.3, 0.2, 0.2});
  ObjectPoints points = pointsOf(truth, 0.001);
  EXPECT_TRUE(proposeCuboid(points, {})->fullySeen());
  for (int i = 0; i < 100; ++i)  // an upright row, 1 cm before the side -y
    points.others.push_back(Eigen::Vector3f(1, 1.79F, 0.1F + 0.002F * static_cast<float>(i)));
  const auto touched = proposeCuboid(points, {});
  const int side = touched->record.object.semiAxes().x() > 0.25 ? 3 : 1;  // of the heading
  for (int i = 0; i < 4; ++i)
    EXPECT_EQ(touched->touched[static_cast<std::size_t>(i)], i == side) << i;
  EXPECT_FALSE(touched->fullySeen());
  for (auto& other : points.others) other.y() -= 0.1F;
  EXPECT_TRUE(proposeCuboid(points, {})->fullySeen()) << "farther away";
}
