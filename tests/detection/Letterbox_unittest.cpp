#include "Letterbox.h"

#include <gtest/gtest.h>

using namespace quadmap;

TEST(Placement, KeepsProportionsAndLiesWhereAsked)
{
  const auto centre = Placement::of({640, 480}, {320, 320}, Fit::Centre);
  EXPECT_EQ(centre.area, cv::Rect(0, 40, 320, 240));
  const auto topLeft = Placement::of({640, 480}, {416, 416}, Fit::TopLeft);
  EXPECT_EQ(topLeft.area, cv::Rect(0, 0, 416, 312));
  const auto stretched = Placement::of({640, 480}, {320, 320}, Fit::Stretch);
  EXPECT_EQ(stretched.area, cv::Rect(0, 0, 320, 320));
  EXPECT_EQ(Placement::of({480, 640}, {320, 320}, Fit::Centre).area, cv::Rect(40, 0, 240, 320));
  EXPECT_EQ(Placement::of({10000, 1}, {32, 32}, Fit::Centre).area.height, 1);
}

TEST(Placement, BringsBoxesBackToTheImage)
{
  for (const Fit fit : {Fit::Centre, Fit::TopLeft, Fit::Stretch})
  {
    const auto place = Placement::of({640, 480}, {416, 320}, fit);
    const cv::Rect area = place.area;
    const ImageBox all = place.toImage(
        {static_cast<double>(area.x), static_cast<double>(area.y),
         static_cast<double>(area.x + area.width), static_cast<double>(area.y + area.height)});
    EXPECT_NEAR(all.x1, 0, 1e-9);
    EXPECT_NEAR(all.y1, 0, 1e-9);
    EXPECT_NEAR(all.x2, 640, 1e-9);
    EXPECT_NEAR(all.y2, 480, 1e-9);
  }
}

TEST(InputBlob, HasTheNumbersThatTheModelAsksFor)
{
  const cv::Mat image(2, 4, CV_8UC3, cv::Scalar(10, 20, 30));  // blue, green, red
  InputBlob::Format format{
      { 4,  4},
      Fit::Centre, 114, ChannelOrder::Rgb, { 1,  2, 3},
      { 10, 20,40}
  };
  InputBlob rgb(format);
  const auto place = rgb.fill(image);
  EXPECT_EQ(place.area, cv::Rect(0, 1, 4, 2));
  const auto at = [](const InputBlob& blob, int channel, int row)
  { return blob.blob().ptr<float>(0, channel)[row * 4 + 3]; };
  EXPECT_FLOAT_EQ(at(rgb, 0, 1), (30 - 1) / 10.f);
  EXPECT_FLOAT_EQ(at(rgb, 1, 2), (20 - 2) / 20.f);
  EXPECT_FLOAT_EQ(at(rgb, 2, 2), (10 - 3) / 40.f);
  EXPECT_FLOAT_EQ(at(rgb, 0, 0), (114 - 1) / 10.f) << "padding";
  EXPECT_FLOAT_EQ(at(rgb, 2, 3), (114 - 3) / 40.f) << "padding";

  format.order = ChannelOrder::Bgr;
  InputBlob bgr(format);
  bgr.fill(image);
  EXPECT_FLOAT_EQ(at(bgr, 0, 1), (10 - 1) / 10.f);
  EXPECT_FLOAT_EQ(at(bgr, 2, 1), (30 - 3) / 40.f);
}

TEST(InputBlob, KeepsNothingOfTheImageBefore)
{
  InputBlob blob({
      {8, 8},
      Fit::Centre, 0, ChannelOrder::Bgr, { 0, 0,0},
      { 1, 1,1}
  });
  blob.fill(cv::Mat(8, 8, CV_8UC3, cv::Scalar(9, 9, 9)));
  blob.fill(cv::Mat(4, 8, CV_8UC3, cv::Scalar(5, 5, 5)));
  EXPECT_FLOAT_EQ(blob.blob().ptr<float>(0, 0)[0], 0);
  EXPECT_FLOAT_EQ(blob.blob().ptr<float>(0, 0)[3 * 8], 5);
}
