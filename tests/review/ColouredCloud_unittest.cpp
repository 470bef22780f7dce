#include "quadmap/review/ColouredCloud.h"

#include <gtest/gtest.h>

#include "../obs/TemporaryFolder.h"
#include "SampleScene.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

namespace
{
const CloudCollector::Selection kEveryPixel{4.5, 1};
}

TEST(ColouredCloud, PlacesAndColoursTheWall)
{
  auto scan = scanOfWall();
  scan->sensorPose = CPose3D(0.1, 0, 1.0, 0, 0, 0);
  CloudCollector collector(0.02, 100000);
  collector.add(*scan, CPose3D(5, 3, 0, M_PI / 2, 0, 0), kEveryPixel);  // faces y
  const Cloud cloud = collector.points();
  ASSERT_GT(cloud.size(), 1500u);
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (const CloudPoint& p : cloud)
  {
    EXPECT_NEAR(p.position.y(), 3 + 0.1 + 2, 1e-3);
    EXPECT_LT(p.normal.y(), -0.9F) << "towards the camera";
    EXPECT_NEAR(p.rgb[0], 200, 3);
    EXPECT_NEAR(p.rgb[1], 30, 3);
    EXPECT_NEAR(p.rgb[2], 20, 3);
    mean += p.position / static_cast<float>(cloud.size());
  }
  // The pixels at the right and lower edges have no neighbours and are left out: 8 of 128 and 96.
  EXPECT_NEAR(mean.x(), 5.0, 0.15);
  EXPECT_NEAR(mean.z(), 1.0, 0.15);
  EXPECT_FALSE(scan->hasPoints3D) << "memory is freed again";
}

TEST(ColouredCloud, KeepsPlacesAndColoursOfThinnedImages)
{
  auto scan = scanOfWall();  // its left half (y > 0) becomes green
  scan->intensityImage.filledRectangle(0, 0, 63, 95, mrpt::img::TColor(10, 220, 40));
  for (const int stride : {1, 2, 3, 5})
  {
    CloudCollector collector(0.005, 100000);
    collector.add(*scan, CPose3D(), {4.5, stride});
    const Cloud cloud = collector.points();
    EXPECT_NEAR(static_cast<double>(cloud.size()) * stride * stride, 120 * 88, 0.1 * 120 * 88)
        << stride;
    for (const CloudPoint& p : cloud)
    {
      EXPECT_NEAR(p.position.x(), 2, 1e-3);
      ASSERT_EQ(p.rgb[1] > 120, p.position.y() > 0) << stride << ": at " << p.position.transpose();
    }
  }
}

TEST(ColouredCloud, AddsNoCellsWhenAPlaceIsSeenAgain)
{
  CloudCollector collector(0.05, 100000);
  collector.add(*scanOfWall(), CPose3D(), kEveryPixel);
  const std::size_t once = collector.points().size();
  for (int i = 0; i < 5; ++i) collector.add(*scanOfWall(), CPose3D(), kEveryPixel);
  EXPECT_EQ(collector.points().size(), once);
}

TEST(ColouredCloud, GrowsItsCellsInsteadOfTheMemory)
{
  constexpr std::size_t kMost = 200;
  CloudCollector collector(0.01, kMost);
  for (int i = 0; i < 4; ++i) collector.add(*scanOfWall(), CPose3D(i, i, 0, i, 0, 0), kEveryPixel);
  EXPECT_LE(collector.points().size(), kMost);
  EXPECT_GT(collector.points().size(), kMost / 10);
  EXPECT_GT(collector.cellSize(), 0.01);
}

TEST(ColouredCloud, LeavesOutMissingAndFarDepth)
{
  auto scan = scanOfWall();
  scan->rangeImage.fill(0);
  CloudCollector nothing(0.01, 1000);
  nothing.add(*scan, CPose3D(), kEveryPixel);
  EXPECT_TRUE(nothing.points().empty());

  CloudCollector nearOnly(0.01, 1000);
  nearOnly.add(*scanOfWall(), CPose3D(), {1.9, 1});
  EXPECT_TRUE(nearOnly.points().empty());
}

TEST(ColouredCloud, RejectsImpossibleOptions)
{
  EXPECT_THROW(CloudCollector(0, 10), std::invalid_argument);
  EXPECT_THROW(CloudCollector(NAN, 10), std::invalid_argument);
  EXPECT_THROW(CloudCollector(0.1, 0), std::invalid_argument);
}
