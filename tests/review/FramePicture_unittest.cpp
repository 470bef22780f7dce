#include "quadmap/review/FramePicture.h"

#include <gtest/gtest.h>

#include "SampleScene.h"

using namespace quadmap;

namespace
{
using Rgb = std::array<int, 3>;

/** A frame of a red wall with one box, from (30, 20) to (90, 70) of 128x96 pixels. */
class FramePicture : public ::testing::Test
{
 protected:
  FramePicture() : scan_(quadmap::testing::scanOfWall())
  {
    boxes_.cameraParams = scan_->cameraParams;
    boxes_.objects.resize(1);
    boxes_.objects[0].label = "chair";
    boxes_.objects[0].box = {30, 20, 90, 70};
    content_.scan = scan_.get();
    content_.boxes = &boxes_;
  }
  ObjectMeasurement& measurement() { return boxes_.objects[0].measurement; }

  mrpt::img::CImage draw() const { return drawFrame(content_); }

  /** Colour of the picture where a pixel of the image has its centre. */
  static Rgb at(const mrpt::img::CImage& picture, double x, double y)
  {
    const double scale = static_cast<double>(picture.getWidth()) / 128;
    const auto* bgr = picture.ptr<std::uint8_t>(
        static_cast<unsigned>((x + 0.5) * scale), static_cast<unsigned>((y + 0.5) * scale));
    return {bgr[2], bgr[1], bgr[0]};
  }

  mrpt::obs::CObservation3DRangeScan::Ptr scan_;
  CObservationObjects boxes_;
  FramePictureContent content_;
};

const Rgb kWall{200, 30, 20}, kBoxGreen{60, 220, 60}, kGrey{150, 150, 150};
}  // namespace

TEST_F(FramePicture, HasTheImageMagnified)
{
  content_.boxes = nullptr;
  const auto picture = draw();
  EXPECT_NEAR(static_cast<double>(picture.getWidth()), 1200, 128);
  EXPECT_EQ(picture.getWidth() * 96, picture.getHeight() * 128);
  EXPECT_EQ(at(picture, 60, 45), kWall);
}

TEST_F(FramePicture, DrawsABoxThatNobodyMeasuredInTheColourOfItsLabel)
{
  const auto one = draw();
  EXPECT_NE(at(one, 30, 50), kWall);
  EXPECT_EQ(at(one, 30, 50), at(one, 90, 50));
  EXPECT_EQ(at(one, 60, 45), kWall) << "inside";
  boxes_.objects[0].label = "cup";
  EXPECT_NE(at(draw(), 30, 50), at(one, 30, 50));
}

TEST_F(FramePicture, MakesDarkColoursLightEnoughForDarkGround)
{
  for (const char* label : {"tv", "potted plant", "dining table", "chair", "cup", "book"})
  {
    boxes_.objects[0].label = label;
    const Rgb color = at(draw(), 30, 50);
    EXPECT_GE(0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2], 130) << label;
  }
}

TEST_F(FramePicture, ShowsWhichEdgesAreUsable)
{
  measurement().kind = MeasurementKind::Partial;
  measurement().edges.emplace();
  (*measurement().edges)[0].state = EdgeState::Occluded;
  (*measurement().edges)[3].state = EdgeState::NearImageBorder;
  const auto picture = draw();
  EXPECT_EQ(at(picture, 30, 60), kGrey) << "left";
  EXPECT_EQ(at(picture, 80, 20), kBoxGreen) << "top";
  EXPECT_EQ(at(picture, 90, 60), kBoxGreen) << "right";
  EXPECT_EQ(at(picture, 40, 70), kGrey) << "bottom";
}

TEST_F(FramePicture, DrawsBoxesThatGiveNothingInGrey)
{
  measurement().kind = MeasurementKind::Rejected;
  measurement().reason = "no depth in the box";
  EXPECT_EQ(at(draw(), 90, 60), kGrey);
}

TEST_F(FramePicture, ProjectsTheMeasuredCuboidAndItsSupport)
{
  // 1 m wide, deep and high, its middle 2 m ahead: the near side is at 1.5 m.
  const Ellipsoid cube({2, 0, 0, 0, 0, 0}, {0.5, 0.5, 0.5});
  measurement().kind = MeasurementKind::Complete;
  measurement().complete.emplace();
  measurement().complete->object_sensor = cube;
  const auto& camera = scan_->cameraParams;
  const double left = camera.cx() - camera.fx() * 0.5 / 1.5;
  const double nearBottom = camera.cy() + camera.fy() * 0.5 / 1.5;
  EXPECT_GT(at(draw(), left, camera.cy() + 5)[1], 200) << "white, but for its smooth rim";
  const auto without = at(draw(), camera.cx(), nearBottom - 3);
  measurement().complete->faces[5].kind = FaceKind::Support;
  EXPECT_NE(at(draw(), camera.cx(), nearBottom - 3), without)
      << "its lower side is seen from above";
}

TEST_F(FramePicture, OutlinesTheObjectsOfTheMap)
{
  content_.boxes = nullptr;
  content_.objects = {
      {"3", "chair", Ellipsoid({3, 0, 0, 0, 0, 0}, {0.3, 0.3, 0.3})}
  };
  const auto& camera = scan_->cameraParams;
  // The outline of a sphere of radius r at distance d has the radius f r / sqrt(d^2 - r^2).
  const double radius = camera.fx() * 0.3 / std::sqrt(9 - 0.09);
  const auto picture = draw();
  EXPECT_NE(at(picture, camera.cx() + radius, camera.cy()), kWall);
  EXPECT_NE(at(picture, camera.cx(), camera.cy() + radius), kWall);
  EXPECT_EQ(at(picture, camera.cx(), camera.cy()), kWall);
}

TEST_F(FramePicture, LeavesOutWhatIsBehindTheCamera)
{
  content_.boxes = nullptr;
  const auto empty = draw();
  content_.objects = {
      {"3", "chair", Ellipsoid({-3, 0, 0, 0, 0, 0}, {0.3, 0.3, 0.3})}
  };
  const auto picture = draw();
  for (double x = 0; x < 128; ++x) EXPECT_EQ(at(picture, x, 48), at(empty, x, 48));
}

TEST_F(FramePicture, TintsMasks)
{
  boxes_.objects[0].mask = ObjectMask{
      40, 30, 2, 2, {1, 0, 0, 1}
  };
  const auto picture = draw();
  EXPECT_NE(at(picture, 40, 30), kWall);
  EXPECT_EQ(at(picture, 41, 30), kWall);
  EXPECT_NE(at(picture, 41, 31), kWall);
}

TEST_F(FramePicture, ShowsTheDepthWithoutColour)
{
  scan_->hasIntensityImage = false;
  content_.boxes = nullptr;
  const Rgb color = at(draw(), 60, 45);
  EXPECT_EQ(color[0], color[1]);
  EXPECT_EQ(color[0], color[2]);
  EXPECT_GT(color[0], 50);
}
