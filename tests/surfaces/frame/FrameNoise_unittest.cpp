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
  usual.depthNoiseFromImage = false;
  return noiseFactor(DepthCloud(scan, usual));
}

}  // namespace

// The camera of (4.1) has steps and jitter besides, a tenth of its noise, which these images lack.
TEST(FrameNoise, IsThatOfTheImageWhateverTheRoom)
{
  for (const int window : {1, 7, 12})
    for (const double factor : {1.0, 1.5, 2.0, 3.0})
    {
      auto scan = furnishedRoom().scan();
      addNoise(scan, factor, window);
      EXPECT_NEAR(factorOf(scan), std::max(1.0, factor / 1.1), 0.15 * factor)
          << "windows of " << window << " px";
    }
}

TEST(FrameNoise, IsInTheCloudUnlessTheOptionsAreToBeBelieved)
{
  auto scan = furnishedRoom().scan();
  addNoise(scan, 2, 7);
  SurfaceOptions options;
  const double factor = factorOf(scan);
  EXPECT_DOUBLE_EQ(DepthCloud(scan, options).noise().sigma(2), factor * DepthNoise().sigma(2));
  options.depthNoiseFromImage = false;
  EXPECT_EQ(DepthCloud(scan, options).noise().sigma(2), DepthNoise().sigma(2));
}

TEST(FrameNoise, IsTheUsualOneWhereAnImageShowsTooLittle)
{
  auto scan = furnishedRoom().scan();
  scan.rangeImage.setZero();
  EXPECT_EQ(factorOf(scan), 1);
}

TEST(FrameNoise, IsBoundedForDrawnDepthAndForImagesOfClutter)
{
  auto scan = furnishedRoom().scan();
  EXPECT_EQ(factorOf(scan), 1);
  std::mt19937 random(7);
  std::uniform_int_distribution<int> anywhere(5000, 50000);
  auto& range = scan.rangeImage;
  for (int v = 0; v < range.rows(); ++v)
    for (int u = 0; u < range.cols(); ++u) range(v, u) = static_cast<uint16_t>(anywhere(random));
  EXPECT_EQ(factorOf(scan), 4);
}
