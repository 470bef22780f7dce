#include "FrameCanvas.h"

#include <gtest/gtest.h>

#include <vector>

using namespace quadmap;

namespace
{
const cv::Scalar kRed(0, 0, 255), kBlue(255, 0, 0), kGreen(0, 255, 0);

/** The rows of a picture in which a channel is strong, first and last. */
std::pair<int, int> rowsOf(const cv::Mat& picture, int channel)
{
  std::pair<int, int> rows{picture.rows, -1};
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      if (picture.at<cv::Vec3b>(y, x)[channel] > 180)
        rows = {std::min(rows.first, y), std::max(rows.second, y)};
  return rows;
}
}  // namespace

TEST(FrameCanvas, KeepsTheRowsOfATextTogether)
{
  FrameCanvas canvas(cv::Mat(900, 1200, CV_8UC3, cv::Scalar::all(0)), PinholeCamera());
  const Eigen::Vector2d at(300, 300);
  canvas.textsAbove(
      at, {
              {"HHH", kRed}
  });
  canvas.textsAbove(
      at, {
              {"HHH",  kBlue},
              {   "",   kRed},
              {"HHH", kGreen}
  });
  const auto red = rowsOf(canvas.picture(), 2), blue = rowsOf(canvas.picture(), 0),
             green = rowsOf(canvas.picture(), 1);
  EXPECT_LE(red.second, 300) << "above the place";
  EXPECT_GT(blue.first, red.second) << "there is an earlier text";
  EXPECT_GT(green.first, blue.second);
  EXPECT_LT(green.first - blue.first, 20) << "one row further";
}

TEST(FrameCanvas, MovesTextsIntoThePicture)
{
  FrameCanvas canvas(cv::Mat(900, 1200, CV_8UC3, cv::Scalar::all(0)), PinholeCamera());
  canvas.textsBelow(
      {
          1195, 895
  },
      {{"HHH", kBlue}});
  canvas.textsAbove(
      {
          -50, -50
  },
      {{"HHH", kGreen}});
  EXPECT_GT(rowsOf(canvas.picture(), 0).first, 880);
  EXPECT_LT(rowsOf(canvas.picture(), 1).second, 18);
  EXPECT_GE(rowsOf(canvas.picture(), 1).second, 8) << "whole letters";
}
