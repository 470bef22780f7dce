#include "frames/FrameRectification.h"

#include <gtest/gtest.h>
#include <mrpt/core/format.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>

#include "../../obs/TemporaryFolder.h"
#include "quadmap/folders/FrameFolder.h"

using namespace quadmap;

namespace
{
cv::Matx33d matrixOf(const mrpt::img::TCamera& c)
{
  return {c.fx(), 0, c.cx(), 0, c.fy(), c.cy(), 0, 0, 1};
}

std::vector<double> distortionOf(const mrpt::img::TCamera& c)
{
  return {c.dist[0], c.dist[1], c.dist[2], c.dist[3], c.dist[4]};
}

/** Where the lens shows what an ideal camera would show at a pixel, by OpenCV. */
cv::Point2d seenAt(const cv::Point2d& ideal, const mrpt::img::TCamera& c)
{
  const std::vector<cv::Point3d> point{
      {(ideal.x - c.cx()) / c.fx(), (ideal.y - c.cy()) / c.fy(), 1}
  };
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(point, cv::Vec3d(), cv::Vec3d(), matrixOf(c), distortionOf(c), pixels);
  return pixels[0];
}
}  // namespace

TEST(FrameRectification, GivesColourTheHeightOfDepthWhenOnlyTheHeightsDiffer)
{
  const TemporaryFolder files;
  FolderContent content;
  content.folder = files.folder().string();
  const auto camera = [](unsigned rows)
  {
    mrpt::img::TCamera c;
    c.setIntrinsicParamsFromValues(60, 60, 31.5, 0.5 * (rows - 1));
    c.ncols = 64;
    c.nrows = rows;
    return c;
  };
  content.camera.color = camera(36);
  content.camera.depth = DepthCamera{camera(48), mrpt::poses::CPose3D()};
  FolderFrame frame;
  frame.time = 1;
  frame.color = files.path("color.png");
  frame.depth = files.path("depth.png");
  cv::imwrite(frame.color, cv::Mat(36, 64, CV_8UC3, cv::Scalar(10, 20, 30)));
  cv::imwrite(frame.depth, cv::Mat(48, 64, CV_16UC1, cv::Scalar(5000)));
  content.frames = {frame};
  const auto scan = FrameFolder(content, {}).scan(0);
  EXPECT_EQ(scan->rangeImage.rows(), 48);
  EXPECT_EQ(scan->intensityImage.getHeight(), 48u);
}

TEST(FrameRectification, ShowsWhatAnIdealCameraWouldShow)
{
  for (const char* name : {"fr1", "fr2"})
  {
    const FolderCamera camera = cameraPreset(name);
    const FrameRectification rectification(camera);
    // An image whose values say where the lens shows them: (x, y) / 4.
    cv::Mat image(480, 640, CV_8UC3), depth(480, 640, CV_16UC1);
    for (int y = 0; y < 480; ++y)
      for (int x = 0; x < 640; ++x)
      {
        image.at<cv::Vec3b>(y, x) =
            cv::Vec3b(static_cast<unsigned char>(x / 4), static_cast<unsigned char>(y / 4), 200);
        depth.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(1000 + 10 * x);
      }
    const cv::Mat color = rectification.color(image), range = rectification.depth(depth);
    for (int y = 20; y < 460; y += 40)
      for (int x = 30; x < 610; x += 40)
      {
        const cv::Point2d p = seenAt(cv::Point2d(x, y), camera.color);
        EXPECT_NEAR(color.at<cv::Vec3b>(y, x)[0], p.x / 4, 1.0) << name << x << "," << y;
        EXPECT_NEAR(color.at<cv::Vec3b>(y, x)[1], p.y / 4, 1.0) << name << x << "," << y;
        EXPECT_EQ(range.at<std::uint16_t>(y, x), 1000 + 10 * std::lround(p.x)) << x << "," << y;
      }
    EXPECT_EQ(range.at<std::uint16_t>(0, 0), 0) << "the lens did not see the corner";
  }
}

TEST(FrameRectification, BringsBoxesToWhereTheObjectIs)
{
  const FolderCamera camera = cameraPreset("fr1");
  const FrameRectification rectification(camera);
  // The lens shows the corners of an ideal box here, and its sides bent: the box around what the
  // detector sees is a little larger.
  const cv::Point2d first = seenAt({420, 60}, camera.color),
                    last = seenAt({560, 150}, camera.color);
  const ImageBox box = rectification.box({first.x, first.y, last.x, last.y});
  EXPECT_NEAR(box.x1, 420, 4);
  EXPECT_NEAR(box.y1, 60, 4);
  EXPECT_NEAR(box.x2, 560, 4);
  EXPECT_NEAR(box.y2, 150, 4);
  EXPECT_GT(std::abs(first.x - 420), 2) << "there is something to rectify";
  // In the middle the lens bends so little that the box is exact.
  const cv::Point2d a = seenAt({300, 240}, camera.color), b = seenAt({340, 270}, camera.color);
  const ImageBox middle = rectification.box({a.x, a.y, b.x, b.y});
  EXPECT_NEAR(middle.x1, 300, 0.1);
  EXPECT_NEAR(middle.y2, 270, 0.1);
}

TEST(FrameRectification, RefusesLensesThatCannotBeUndone)
{
  for (const auto& name : cameraPresetNames())
    EXPECT_EQ(whyNotRectifiable(cameraPreset(name)), std::nullopt) << name;
  FolderCamera camera;
  camera.color.ncols = 640;
  camera.color.nrows = 480;
  camera.color.setIntrinsicParamsFromValues(400, 400, 319.5, 239.5);  // corners at 45 degrees
  const auto why = [&](double k1, double k2, double p1, double k3)
  {
    camera.color.setDistortionPlumbBob(k1, k2, p1, 0, k3);
    return whyNotRectifiable(camera).value_or("");
  };
  EXPECT_EQ(why(-0.28, 0.07, 1e-4, 0), "") << "a wide lens";
  EXPECT_EQ(why(-0.3, 0.1, 1e-4, -0.01), "");
  EXPECT_EQ(why(0.1, 0.05, 0.01, 0), "");
  // r (1 - 5 r^2) grows up to r^2 = 1/15, where it is 0.172, which is 69 px.
  const std::string folds = why(-5, 0, 0, 0);
  EXPECT_EQ(folds, "the lens (k1=-5 k2=0 p1=0 p2=0 k3=0) folds the image 69 px from its centre");
  EXPECT_NE(why(-1e6, 0, 0, 0).find("folds the image 0 px"), std::string::npos);
  EXPECT_NE(why(0, 0, 0, -0.5).find("folds the image "), std::string::npos);
  EXPECT_NE(why(5, 0, 0, 0).find("bends the image too much "), std::string::npos);
  EXPECT_NE(why(0, 0, 2, 0).find("bends the image too much "), std::string::npos);
}

TEST(FrameRectification, FindsTheFoldWhereTheImageHasIt)
{
  FolderCamera camera;
  auto& c = camera.color;
  c.ncols = 640;
  c.nrows = 480;
  c.setIntrinsicParamsFromValues(486, 486, 319.5, 239.5);
  c.setDistortionPlumbBob(-0.268, 0.0237, 0, 0, 0);
  const auto seen = [&](double r) { return seenAt({c.cx() + r, c.cy()}, c).x - c.cx(); };  // [px]
  double fold = 0;  // what the lens shows farthest out, without the lens [px]
  while (fold < 1000 && seen(fold + 1) > seen(fold)) ++fold;
  ASSERT_LT(seen(fold), 399) << "the distance of the corners";
  const std::string why = whyNotRectifiable(camera).value_or("");
  const std::string what = mrpt::format(" folds the image %.0f px from its centre", seen(fold));
  EXPECT_NE(why.find(what), std::string::npos) << why << what;
  // The corners are of points at 45 degrees; the lens folds what is at 48 degrees, out of sight.
  c.setIntrinsicParamsFromValues(355, 355, 319.5, 239.5);
  c.setDistortionPlumbBob(0.188, 0.129, 0, 0, -0.195);
  EXPECT_EQ(whyNotRectifiable(camera), std::nullopt);
  // This one would show in the corners of the rectified image what it has beside them already.
  c.setDistortionPlumbBob(0.4, 0, 0, 0, -0.26);
  EXPECT_NE(whyNotRectifiable(camera).value_or("").find(" folds the image "), std::string::npos);
}

TEST(FrameRectification, LeavesEdgesAtTheBorderThere)
{
  const FrameRectification rectification(cameraPreset("fr1"));
  const ImageBox box = rectification.box({0.5, 100, 639, 478});
  EXPECT_LE(box.x1, 0);
  EXPECT_GE(box.x2, 639);
  EXPECT_GE(box.y2, 479);
  EXPECT_GT(box.y1, 100) << "not at the border: rectified";
  const ImageBox wrong = rectification.box({9, 9, 5, 5});
  EXPECT_EQ(wrong.x1, 9) << "what is no box is left as it is";
  EXPECT_EQ(rectification.box({-1e300, -1e300, 1e300, 1e300}).x2, 1e300);
}

TEST(FrameRectification, BringsColourToTheSizeOfDepth)
{
  FolderCamera camera;
  camera.color.ncols = 1296;
  camera.color.nrows = 968;
  camera.color.setIntrinsicParamsFromValues(1170, 1170, 647.5, 483.5);
  camera.depth = DepthCamera{};
  camera.depth->camera.ncols = 640;
  camera.depth->camera.nrows = 480;
  const auto rectified = rectifiedCameraOf(camera);
  EXPECT_EQ(rectified.ncols, 640u);
  EXPECT_NEAR(rectified.cx(), 319.5, 1e-9) << "the centre of the image stays there";
  EXPECT_NEAR(rectified.fx(), 1170 * 640 / 1296.0, 1e-9);
  EXPECT_NEAR(rectified.fy(), 1170 * 480 / 968.0, 1e-9);
  const FrameRectification rectification(camera);
  cv::Mat image(968, 1296, CV_8UC3, cv::Scalar::all(0));
  image.colRange(648, 1296).setTo(cv::Scalar::all(200));
  const cv::Mat small = rectification.color(image);
  ASSERT_EQ(small.size(), cv::Size(640, 480));
  EXPECT_EQ(small.at<cv::Vec3b>(240, 319)[0], 0);
  EXPECT_EQ(small.at<cv::Vec3b>(240, 320)[0], 200);
  const ImageBox box = rectification.box({0, 484, 648, 967});
  EXPECT_NEAR(box.x2, 320, 0.5);
  EXPECT_NEAR(box.y1, 240, 0.5);
}
