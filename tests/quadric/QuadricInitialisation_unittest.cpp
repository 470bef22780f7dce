#include "quadmap/quadric/QuadricInitialisation.h"

#include <gtest/gtest.h>

#include "BoxScene.h"
#include "quadmap/geometry/RobustStatistics.h"
#include "quadmap/geometry/RotationDistance.h"
#include "quadmap/geometry/ViewAngles.h"

using namespace quadmap;
using namespace quadmap::testing;

namespace
{
Ellipsoid tilted()
{
  return {
      mrpt::poses::CPose3D(5.2, -3.1, 0.7, 0.6, 0.15, -0.1), {0.45, 0.25, 0.35}
  };
}

LabelProperties suitcase()
{
  LabelProperties label;
  label.typicalSize = {0.8, 0.6, 0.7};
  label.sizeSpread = 0.4;
  return label;
}

/** Largest difference of the dual quadrics, [m^2]: independent of how the axes are named. */
double difference(const Ellipsoid& a, const Ellipsoid& b)
{
  return (a.dualQuadric() - b.dualQuadric()).cwiseAbs().maxCoeff();
}

}  // namespace

TEST(QuadricInitialisation, RecoversTheEllipsoidFromExactBoxes)
{
  for (const int views : {3, 4, 10})
  {
    const auto found = ellipsoidTouching(boxesOnArc(tilted(), views, 1.8));
    ASSERT_TRUE(found) << views;
    EXPECT_LT((found->center() - tilted().center()).norm(), 1e-6) << "[m], " << views;
    EXPECT_LT((found->semiAxes() - tilted().semiAxes()).cwiseAbs().maxCoeff(), 1e-6)
        << "[m], z is the axis nearest to up and the tilt is small; x may be the other one";
    EXPECT_LT(symmetricRotationDistance(found->rotation(), tilted().rotation()).angle, 1e-5);
    EXPECT_LT(difference(*found, tilted()), 1e-5) << "[m^2], 6 m from the origin";
  }
}

TEST(QuadricInitialisation, UsesBoxesThatAreCut)
{
  auto boxes = boxesOnArc(tilted(), 6, 1.8);
  for (std::size_t i = 0; i < boxes.size(); ++i)
  {
    boxes[i].usable[i % 4] = false;
    boxes[i].edges[i % 4].n =
        boxes[i].edges[i % 4].n.cross(Eigen::Vector3d(0.3, 0.1, 1)).normalized();
  }
  const auto found = ellipsoidTouching(boxes);
  ASSERT_TRUE(found);
  EXPECT_LT(difference(*found, tilted()), 1e-5)
      << "[m^2]; a wrong edge that is not usable is not used";
}

TEST(QuadricInitialisation, ErrorsAreAsSmallAsTheNoiseOfBoxesAllows)
{
  // A pixel at 2.5 m is 5 mm; 20 views on a half circle. 200 trials.
  std::mt19937 random(7);
  std::vector<double> position, size;
  int refused = 0;
  for (int trial = 0; trial < 200; ++trial)
  {
    const auto found = ellipsoidTouching(boxesOnArc(tilted(), 20, M_PI, 1.0, &random));
    if (!found)
    {
      ++refused;
      continue;
    }
    position.push_back((found->center() - tilted().center()).norm());
    size.push_back(std::abs(std::cbrt(found->cuboidVolume() / tilted().cuboidVolume()) - 1));
  }
  EXPECT_LE(refused, 2);
  EXPECT_LT(median(position), 0.005) << "[m]";
  EXPECT_LT(median(size), 0.02);
}

TEST(QuadricInitialisation, RefusesViewsFromOnePlace)
{
  const Ellipsoid object = tilted();
  const Eigen::Vector3d eye = object.center() + Eigen::Vector3d(2, 1, 0.5);
  std::mt19937 random(8);
  for (const double sigma_px : {0.0, 1.0})
  {
    std::vector<PlacedBox> boxes;
    for (int i = 0; i < 6; ++i)
    {
      const Eigen::Vector3d beside(0.1 * i - 0.2, 0.05 * i, 0.06 * i - 0.2);
      boxes.push_back(boxOf(object, lookingAt(eye, object.center() + beside), sigma_px, &random));
    }
    EXPECT_FALSE(triangulatedCenter(boxes)) << sigma_px;
    EXPECT_FALSE(ellipsoidTouching(boxes)) << sigma_px;
    EXPECT_NEAR(parallax(object.center(), camerasOf(boxes)), 0, 1e-6);
  }
}

TEST(QuadricInitialisation, RefusesFewerThanThreeViews)
{
  EXPECT_FALSE(ellipsoidTouching({}));
  EXPECT_FALSE(ellipsoidTouching(boxesOnArc(tilted(), 2, 1.8)));
  auto boxes = boxesOnArc(tilted(), 3, 1.8);
  for (auto& box : boxes) box.usable[0] = box.usable[3] = false;
  EXPECT_FALSE(ellipsoidTouching(boxes)) << "six edges";
}

TEST(QuadricInitialisation, RefusesWhatIsNotAnEllipsoid)
{
  // Boxes of three things that have nothing to do with each other.
  std::vector<PlacedBox> boxes;
  for (int i = 0; i < 3; ++i)
  {
    const Ellipsoid other(
        mrpt::poses::CPose3D(0.9 * i, -0.8 * (i % 2), 0.4 * i, 0, 0, 0),
        Eigen::Vector3d(0.05 + 0.4 * i, 0.3, 0.1));
    const double angle = 2.1 * i;
    boxes.push_back(boxOf(
        other, lookingAt(
                   other.center() + Eigen::Vector3d(3 * std::cos(angle), 3 * std::sin(angle), 1),
                   other.center())));
  }
  const auto found = ellipsoidTouching(boxes);
  EXPECT_TRUE(!found || !isPlausible(*found, boxes, suitcase(), 3.0));
}

TEST(QuadricInitialisation, CentreIsWhereTheBoxesPoint)
{
  const auto boxes = boxesOnArc(tilted(), 8, 2.0);
  const auto center = triangulatedCenter(boxes);
  ASSERT_TRUE(center);
  EXPECT_LT((*center - tilted().center()).norm(), 0.03)
      << "[m]: the middle of an outline is not the centre's image, by a few per cent of the size";
  EXPECT_NEAR(parallax(tilted().center(), camerasOf(boxes)), 1.9, 0.15)
      << "[rad], an arc of 2 seen from above";
}

TEST(QuadricInitialisation, PlausibleObjectsHaveUsualSizesAndAreInFront)
{
  const auto boxes = boxesOnArc(tilted(), 4, 1.5);
  EXPECT_TRUE(isPlausible(tilted(), boxes, suitcase(), 3.0));
  const Ellipsoid huge(tilted().pose(), 4.0 * tilted().semiAxes());
  EXPECT_FALSE(isPlausible(huge, boxes, suitcase(), 3.0)) << "exp(3 * 0.4) = 3.3 times is the most";
  const Eigen::Vector3d behind = 2 * boxes[0].camera - tilted().center();
  const Ellipsoid there(
      mrpt::poses::CPose3D(behind.x(), behind.y(), behind.z(), 0, 0, 0), tilted().semiAxes());
  EXPECT_FALSE(isPlausible(there, boxes, suitcase(), 3.0));
}

TEST(QuadricInitialisation, NamesAxesWithoutChangingTheEllipsoid)
{
  const Ellipsoid lying(mrpt::poses::CPose3D(1, 2, 3, 0.4, 1.5, 0.2), {0.2, 0.3, 0.9});
  const auto [named, order] = withAxesNamedUpright(lying);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(named.semiAxes()[static_cast<Eigen::Index>(i)], lying.semiAxes()[order[i]], 1e-12);
  EXPECT_LT(difference(lying, named), 1e-12);
  EXPECT_GT(named.rotation()(2, 2), 0.7);
  EXPECT_NEAR(named.rotation().determinant(), 1, 1e-9);
  EXPECT_NEAR(named.semiAxes().z(), 0.2, 1e-9) << "its x axis points down";
}
