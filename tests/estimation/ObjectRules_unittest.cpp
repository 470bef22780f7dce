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

const ImageBox kBox{100, 100, 200, 200}, kBeside{130, 100, 230, 200};  // IoU 0.54

DetectedObject boxOf(const std::string& label, double score, const ImageBox& box)
{
  DetectedObject detected;
  detected.label = label;
  detected.score = score;
  detected.box = box;
  return detected;
}

std::vector<bool> staying(const std::vector<DetectedObject>& boxes)
{
  return surestOfTwins(boxes, LabelTable::installed(), {});
}

using Stay = std::vector<bool>;

double likelihoodAt(const Eigen::Vector3d& place, double wrongDepthShare)
{
  AgreementOptions options;
  options.wrongDepthShare = wrongDepthShare;
  return positionLogLikelihood(partialView(), objectAt(place), options);
}
}  // namespace

TEST(SurestOfTwins, OfTwoNamesForAThingTheSurerOneStays)
{
  // YOLOX on the first image of tum_fr2_desk: a monitor with its keyboard makes a laptop, too.
  const std::vector<DetectedObject> desk{
      boxOf("laptop", 0.54, {189, 95, 387, 270}), boxOf("tvmonitor", 0.72, {238, 95, 385, 227}),
      boxOf("keyboard", 0.83, {201, 259, 391, 315})};
  EXPECT_EQ(staying(desk), Stay({false, true, true}));
}

TEST(SurestOfTwins, NeighboursOfOneLabelAndThingsInFrontOfOthersStay)
{
  EXPECT_EQ(staying({boxOf("chair", 0.5, kBox), boxOf("chair", 0.9, kBeside)}), Stay(2, true));
  EXPECT_EQ(staying({boxOf("chair", 0.5, kBox), boxOf("cup", 0.9, kBeside)}), Stay(2, true));
  EXPECT_EQ(staying({boxOf("chair", 0.5, kBox), boxOf("cup", 0.9, kBox)}), Stay({false, true}));
}

TEST(SurestOfTwins, WhatGoesTakesNothingWithIt)
{
  const ImageBox third{160, 100, 260, 200};
  const std::vector<DetectedObject> row{
      boxOf("chair", 0.5, kBox), boxOf("couch", 0.6, kBeside), boxOf("chair", 0.9, third)};
  EXPECT_EQ(staying(row), Stay({true, false, true}));
}

TEST(SurestOfTwins, AScoreThatIsNoNumberIsTheLeast)
{
  EXPECT_EQ(
      staying({boxOf("cup", NAN, kBox), boxOf("cup", 0.1, kBox), boxOf("cup", NAN, kBox)}),
      Stay({false, true, false}));
}

TEST(SurestOfTwins, AsSureOnesAreTwinsOnlyAroundTheSamePixels)
{
  EXPECT_EQ(staying({boxOf("cup", 1, kBox), boxOf("cup", 1, kBox)}), Stay({true, false}));
  std::vector<DetectedObject> truth{boxOf("chair", 1, kBox), boxOf("couch", 1, kBeside)};
  EXPECT_EQ(staying(truth), Stay(2, true));
  truth[1].box = kBox;
  truth[0].instanceId = 1;
  truth[1].instanceId = 2;
  EXPECT_EQ(staying(truth), Stay(2, true)) << "two things, as whoever gave the numbers knows";
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
