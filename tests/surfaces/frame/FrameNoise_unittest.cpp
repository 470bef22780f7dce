#include "frame/FrameNoise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "../SyntheticFrame.h"

using namespace quadmap;

namespace
{
/** Two cabinets, a table's top and the floor, at 1 to 5 m. */
SyntheticFrame furnishedRoom()
{
  SyntheticFrame frame;
  frame.add(2.5, 0.6, 0, 0.4, {0.5, 0.8, 1.2});
  frame.add(2.0, -0.7, 0, -0.2, {0.6, 0.9, 0.7});
  frame.add(1.4, 0.1, 0.7, 0.1, {0.8, 0.6, 0.04});
  return frame;
}

/** Adds normal errors to each depth, `factor` times as large as (4.1) says.
 * \param window Width of the squares of pixels that share their errors: the mean of as many. */
void addNoise(mrpt::obs::CObservation3DRangeScan& scan, double factor, int window)
{
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  auto& range = scan.rangeImage;
  const int rows = static_cast<int>(range.rows()), columns = static_cast<int>(range.cols());
  const Eigen::MatrixXd white = Eigen::MatrixXd::NullaryExpr(
      rows + window, columns + window, [&]() { return normal(random); });
  for (int v = 0; v < rows; ++v)
    for (int u = 0; u < columns; ++u)
    {
      const double z = range(v, u) * double(scan.rangeUnits);
      const double error = white.block(v, u, window, window).sum() / window;
      if (z > 0)
        range(v, u) = static_cast<uint16_t>(
            std::lround((z + factor * DepthNoise().sigma(z) * error) / double(scan.rangeUnits)));
    }
}

double factorOf(const mrpt::obs::CObservation3DRangeScan& scan)
{
  SurfaceOptions usual;
  usual.maxDepthNoiseFactor = 1;
  return noiseFactor(DepthCloud(scan, usual), 4);
}

}  // namespace

// The images lack the steps and the jitter of the camera of (4.1), and the windows make blocks of
// planes differ: hence less than the factor, by nearly the same in both rooms.
TEST(FrameNoise, IsThatOfTheImageInBothRooms)
{
  for (const bool isFurnished : {false, true})
    for (const int window : {1, 7, 12})
      for (const double factor : {1.1, 2.0, 3.0})
      {
        auto scan = (isFurnished ? furnishedRoom() : SyntheticFrame()).scan();
        addNoise(scan, factor, window);
        if (factor < 1.2)
          EXPECT_EQ(factorOf(scan), 1) << "too little to be clear";
        else
          EXPECT_NEAR(factorOf(scan) / factor, 0.79, 0.075)
              << factor << " times the noise, windows of " << window << " px";
      }
}

TEST(FrameNoise, IsInTheCloudUnlessTheOptionsAreToBeBelieved)
{
  auto scan = furnishedRoom().scan();
  addNoise(scan, 2, 7);
  SurfaceOptions options;
  EXPECT_DOUBLE_EQ(
      DepthCloud(scan, options).noise().sigma(2), factorOf(scan) * DepthNoise().sigma(2));
  options.maxDepthNoiseFactor = 1;
  EXPECT_DOUBLE_EQ(DepthCloud(scan, options).noise().sigma(2), DepthNoise().sigma(2));
}

TEST(FrameNoise, IsTheUsualOneWhereAnImageShowsNothing)
{
  auto scan = furnishedRoom().scan();
  EXPECT_EQ(factorOf(scan), 1) << "drawn depth has no noise";
  scan.rangeImage.setZero();
  EXPECT_EQ(factorOf(scan), 1);
}

/** Depths that have nothing to do with each other, in some rows from the top. */
mrpt::obs::CObservation3DRangeScan clutter(int rows)
{
  auto scan = furnishedRoom().scan();
  std::mt19937 random(7);
  std::uniform_int_distribution<int> anywhere(5000, 50000);
  auto& range = scan.rangeImage;
  for (int v = 0; v < range.rows(); ++v)
    for (int u = 0; u < range.cols(); ++u)
      range(v, u) = static_cast<uint16_t>(v < rows ? anywhere(random) : 0);
  return scan;
}

TEST(FrameNoise, IsBoundedForImagesOfClutter)
{
  EXPECT_NEAR(factorOf(clutter(480)), 4, 0.1);
  // A row of 38 blocks, with 4 times the noise each, and 20 with the usual one. Those at the
  // image's border have too few bends.
  EXPECT_NEAR(factorOf(clutter(16)), (38 * 4 + 20) / 58.0, 0.01);
}
