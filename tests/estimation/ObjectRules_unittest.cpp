#include "quadmap/estimation/ObjectRules.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace quadmap;

namespace
{
/** What a camera at the origin knows of a thing in the direction of x without having measured it:
 * a place 4 m away, which is that of another thing now and then. */
ObjectView partialView()
{
  ObjectView view;
  view.label = "potted plant";
  view.center = {4, 0, 0};
  view.centerCovariance = Eigen::Vector3d(0.25, 0.1, 0.1).array().square().matrix().asDiagonal();
  view.wrongDepthSigma = 1.5;
  return view;
}

MapObject objectAt(const Eigen::Vector3d& place)
{
  MapObject object;
  object.object =
      Ellipsoid(mrpt::poses::CPose3D(place.x(), place.y(), place.z(), 0, 0, 0), {0.3, 0.3, 0.5});
  object.covariance = 1e-4 * UprightCovariance::Identity();
  return object;
}

DetectedObject boxOf(const std::string& label, double score, const ImageBox& box)
{
  DetectedObject detected;
  detected.label = label;
  detected.score = score;
  detected.box = box;
  return detected;
}

bool isDropped(const std::vector<DetectedObject>& boxes, std::size_t k)
{
  return hasBetterTwin(boxes, k, LabelTable::installed(), {});
}

double likelihoodAt(const Eigen::Vector3d& place, double wrongDepthShare)
{
  AgreementOptions options;
  options.wrongDepthShare = wrongDepthShare;
  return positionLogLikelihood(partialView(), objectAt(place), options);
}
}  // namespace

TEST(BetterTwin, OfTwoNamesForAThingTheSurerOneStays)
{
  // YOLOX on the first image of tum_fr2_desk: a monitor with its keyboard makes a laptop, too.
  const std::vector<DetectedObject> desk{
      boxOf("laptop", 0.54, {189, 95, 387, 270}), boxOf("tvmonitor", 0.72, {238, 95, 385, 227}),
      boxOf("keyboard", 0.83, {201, 259, 391, 315})};
  EXPECT_TRUE(isDropped(desk, 0));
  EXPECT_FALSE(isDropped(desk, 1));
  EXPECT_FALSE(isDropped(desk, 2));
}

TEST(BetterTwin, NeighboursOfOneLabelAndThingsInFrontOfOthersStay)
{
  const ImageBox box{100, 100, 200, 200}, beside{130, 100, 230, 200};  // IoU 0.54
  EXPECT_FALSE(isDropped({boxOf("chair", 0.5, box), boxOf("chair", 0.9, beside)}, 0));
  EXPECT_FALSE(isDropped({boxOf("chair", 0.5, box), boxOf("cup", 0.9, beside)}, 0));
  EXPECT_TRUE(isDropped({boxOf("chair", 0.5, box), boxOf("cup", 0.9, box)}, 0));
  EXPECT_TRUE(isDropped({boxOf("cup", 0.5, box), boxOf("cup", 0.5, box)}, 1)) << "one of two stays";
  EXPECT_FALSE(isDropped({boxOf("cup", 0.5, box), boxOf("cup", 0.5, box)}, 0));
}

TEST(PartialPosition, IsADensity)
{
  const double step = 0.1, area = 0.05 * 0.05;  // of the grid along the ray [m] and across it [m^2]
  double sum = 0;
  for (int i = -80; i <= 80; ++i)
    for (int j = -20; j <= 20; ++j)
      for (int k = -20; k <= 20; ++k)
        sum += step * area * std::exp(likelihoodAt({4 + step * i, 0.05 * j, 0.05 * k}, 0.05));
  EXPECT_NEAR(sum, 1, 1e-3);
}

TEST(PartialPosition, OfWhatHidesAThingIsStillOfTheThing)
{
  const double newObject = -std::log(100.0);  // the density of objects that nobody knows, 1/m^3
  EXPECT_GT(likelihoodAt({6, 0, 0}, 0.05), newObject);
  EXPECT_LT(likelihoodAt({6, 0, 0}, 0), newObject - 10) << "were every depth the thing's";
  EXPECT_LT(likelihoodAt({6, 1.2, 0}, 0.05), newObject - 10) << "beside the ray";
  EXPECT_LT(likelihoodAt({12, 0, 0}, 0.05), newObject - 5) << "too large for its box";
}

TEST(PartialPosition, IsMostLikelyWhereTheDepthIs)
{
  for (const double x : {2.0, 3.0, 5.0, 6.0})
    EXPECT_GT(likelihoodAt({4, 0, 0}, 0.05), likelihoodAt({x, 0, 0}, 0.05));
}

TEST(MeasurementOf, TellsLittleWithTheDepthOfAnother)
{
  const LabelTable labels = LabelTable::installed();
  const ObjectView view = partialView();
  MapObject object = objectAt({4.1, 0, 0});
  object.labelCounts["potted plant"] = 1;
  const auto own = measurementOf(object, view, labels, {});
  ASSERT_TRUE(own);
  EXPECT_TRUE(own->hasOwnDepth);
  EXPECT_EQ(own->centerCovariance, view.centerCovariance);

  object.object = objectAt({6, 0, 0}).object;
  const auto hidden = measurementOf(object, view, labels, {});
  ASSERT_TRUE(hidden);
  EXPECT_FALSE(hidden->hasOwnDepth);
  Eigen::Matrix3d expected = view.centerCovariance;
  expected(0, 0) += view.wrongDepthSigma * view.wrongDepthSigma;  // the ray is the x axis
  EXPECT_TRUE(hidden->centerCovariance.isApprox(expected, 1e-12));
}

TEST(MeasurementOf, IsNothingAsAnotherKindOfThing)
{
  MapObject object = objectAt({4, 0, 0});
  object.labelCounts["tv"] = 1;
  EXPECT_FALSE(measurementOf(object, partialView(), LabelTable::installed(), {}));
}
