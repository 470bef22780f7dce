#include "quadmap/simulator/SimulatedDetector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "../SceneFixture.h"

namespace quadmap::simulator
{
namespace
{
const std::string kChairAndCups =
    "[object a_chair]\nlabel = chair\nposition = 2 0 0\npart1 = box 0 0 0.8 0.4 0.4 0.8 grey\n"
    "[object b_cup]\nlabel = cup\nposition = 1.2 0.4 1.3\npart1 = cylinder 0 0 0 0.2 0.2 0.2 grey\n"
    "[object c_lamp]\nlabel = none\nposition = 1.2 -0.4 1.3\n"
    "part1 = ellipsoid 0 0 0 0.3 0.3 0.3 grey\n";

PinholeCamera vga() { return CameraOptions().pinhole(); }

TEST(VisibleObjects, BoxesEncloseTheProjectedVisibleSurface)
{
  const Scene scene = homeScene();
  const PinholeCamera camera = vga();
  const mrpt::poses::CPose3D pose(-1.9, 1.2, 1.4, -0.4, 0.3, 0.05);
  const RenderedFrame frame = RayCaster(scene, camera).render(pose);
  const auto visible = visibleObjects(scene, frame, DetectorOptions());
  ASSERT_GE(visible.size(), 6U);
  std::mt19937 random(2);
  for (const auto& seen : visible)
  {
    ImageBox sampled{1e9, 1e9, -1e9, -1e9};
    const SceneObject& object = scene.objects[seen.object];
    for (const auto& part : object.parts)
      for (int i = 0; i < 30000; ++i)
      {
        const Eigen::Vector3d world =
            transformed(object.T_world_obj + part.T_obj_prim, surfacePoint(part, random));
        const Eigen::Vector3d p = inverted(pose, world);
        if (p.x() < 0.1) continue;
        const Eigen::Vector2d q = camera.project({-p.y(), -p.z(), p.x()});
        if (q.x() < 0 || q.y() < 0 || q.x() > camera.width - 1 || q.y() > camera.height - 1)
          continue;
        const auto pixel = static_cast<std::size_t>(std::lround(q.y())) * camera.width +
                           static_cast<std::size_t>(std::lround(q.x()));
        if (p.x() > static_cast<double>(frame.depth[pixel]) + 0.01) continue;  // hidden
        sampled = {
            std::min(sampled.x1, q.x()), std::min(sampled.y1, q.y()), std::max(sampled.x2, q.x()),
            std::max(sampled.y2, q.y())};
      }
    // Pixels are whole numbers, and the samples a few pixels apart on the nearest objects.
    EXPECT_NEAR(sampled.x1, seen.box.x1, 2.5) << object.name;
    EXPECT_NEAR(sampled.y1, seen.box.y1, 2.5) << object.name;
    EXPECT_NEAR(sampled.x2, seen.box.x2, 2.5) << object.name;
    EXPECT_NEAR(sampled.y2, seen.box.y2, 2.5) << object.name;
  }
}

TEST(VisibleObjects, NeedALabelEnoughToSeeAndEnoughPixels)
{
  const Scene scene = sceneFromText(kRoomText + kChairAndCups);
  const RenderedFrame frame = RayCaster(scene, vga()).render(lookingAhead());
  DetectorOptions options;
  const auto visible = visibleObjects(scene, frame, options);
  ASSERT_EQ(2U, visible.size()) << "no lamp";
  EXPECT_EQ(0U, visible[0].object);
  EXPECT_EQ(1U, visible[1].object);
  EXPECT_GT(visible[1].visibleShare, 0.99);
  options.minSize = 100;  // the cup has about 90 px
  EXPECT_EQ(1U, visibleObjects(scene, frame, options).size());
}

TEST(VisibleObjects, ShareIsWhatOcclusionAndTheImageLeave)
{
  const Scene scene = sceneFromText(
      kRoomText +
      "[object a_box]\nlabel = suitcase\nposition = 2.5 0 1.3\npart1 = box 0 0 0 0.01 1 1 grey\n"
      "[object screen]\nlabel = none\nposition = 1.25 0.25 1.3\n"
      "part1 = box 0 0 0 0.001 0.3 1 grey\n");
  // The screen at half the distance covers y from 0.2 to 0.8: three tenths of the box.
  const RenderedFrame frame = RayCaster(scene, vga()).render(lookingAhead());
  DetectorOptions options;
  const auto visible = visibleObjects(scene, frame, options);
  ASSERT_EQ(1U, visible.size());
  EXPECT_NEAR(0.7, visible[0].visibleShare, 0.01) << "2 px of 210";
  options.minVisible = 0.72;
  EXPECT_TRUE(visibleObjects(scene, frame, options).empty());

  mrpt::poses::CPose3D aside = lookingAhead();
  aside.setYawPitchRoll(-std::atan(320.0 / 525.0), 0, 0);  // its middle on the left border
  const auto cut = visibleObjects(scene, RayCaster(scene, vga()).render(aside), DetectorOptions());
  ASSERT_EQ(1U, cut.size());
  EXPECT_EQ(0, cut[0].box.x1) << "the box ends where the image does";
  EXPECT_LT(cut[0].visibleShare, 0.55) << "the right half of it, and nothing hides that";
  EXPECT_GT(cut[0].visibleShare, 0.40) << "perspective makes the outer half the larger one";
}

class Detector : public ::testing::Test
{
 protected:
  const Scene scene = sceneFromText(kRoomText + kChairAndCups);
  const LabelTable labels = LabelTable::installed();
  const ImageBox box{200, 150, 400, 350};

  /** All detections of one object in many frames, in which its share `visibleShare` is visible. */
  std::vector<DetectedObject> detections(
      const DetectorOptions& options, int frames, double visibleShare = 1, std::size_t object = 0)
  {
    const SimulatedDetector detector(scene, options, labels);
    std::vector<DetectedObject> all;
    for (int i = 0; i < frames; ++i)
    {
      RandomStream random(1, Purpose::Detector, static_cast<std::uint64_t>(i));
      const VisibleObject seen{object, box, visibleShare, box};
      for (auto& found : detector.detect({seen}, vga(), random).boxes) all.push_back(found);
    }
    return all;
  }
};

TEST_F(Detector, FaultlessDetectorReturnsTheBox)
{
  for (const auto& found : detections(faultless(), 100))
  {
    EXPECT_EQ("chair", found.label);
    EXPECT_EQ(box.x1, found.box.x1);
    EXPECT_EQ(box.y1, found.box.y1);
    EXPECT_EQ(box.x2, found.box.x2);
    EXPECT_EQ(box.y2, found.box.y2);
    EXPECT_GT(found.score, 0.7);
    EXPECT_LT(found.score, 1);
    EXPECT_FALSE(found.instanceId) << "a detector does not know instances";
  }
  EXPECT_EQ(100U, detections(faultless(), 100).size());
}

TEST_F(Detector, SaysWhichObjectEachBoxShows)
{
  DetectorOptions options = faultless();
  options.missRate = 0.4;
  options.falseAlarms = 0.7;
  const SimulatedDetector detector(scene, options, labels);
  const ImageBox boxes[2] = {
      {100, 100, 200, 200},
      {400, 150, 500, 350}
  };
  unsigned chairs = 0, cups = 0, alarms = 0;
  for (std::uint64_t i = 0; i < 200; ++i)
  {
    RandomStream random(1, Purpose::Detector, i);
    const auto found = detector.detect(
        {
            {0, boxes[0], 1, boxes[0]},
            {1, boxes[1], 1, boxes[1]}
    },
        vga(), random);
    ASSERT_EQ(found.boxes.size(), found.truth.size());
    for (std::size_t k = 0; k < found.boxes.size(); ++k)
    {
      const auto truth = found.truth[k];
      alarms += !truth;
      if (!truth) continue;
      EXPECT_EQ(boxes[*truth].x1, found.boxes[k].box.x1);
      EXPECT_EQ(*truth == 0 ? "chair" : "cup", found.boxes[k].label);
      ++(*truth == 0 ? chairs : cups);
    }
  }
  EXPECT_NEAR(120, chairs, 4 * std::sqrt(200 * 0.6 * 0.4));
  EXPECT_NEAR(120, cups, 4 * std::sqrt(200 * 0.6 * 0.4));
  EXPECT_NEAR(140, alarms, 4 * std::sqrt(200 * 0.7 * 0.3));
}

TEST_F(Detector, EdgesJitterWithTheirSigma)
{
  DetectorOptions options = faultless();
  options.jitter = 3;
  std::vector<double> left, bottom;
  for (const auto& found : detections(options, 4000))
  {
    left.push_back(found.box.x1 - box.x1);
    bottom.push_back(found.box.y2 - box.y2);
  }
  for (const auto& errors : {left, bottom})
  {
    EXPECT_NEAR(0, momentsOf(errors).mean, 4 * 3 / 63.2);
    EXPECT_NEAR(3, momentsOf(errors).deviation, 4 * 3 / 89.4);
  }
}

TEST_F(Detector, LargeBoxesErrMore)
{
  DetectorOptions options = faultless();
  options.jitter = 1;
  options.relativeJitter = 0.02;  // of 200 px
  std::vector<double> top;
  for (const auto& found : detections(options, 4000)) top.push_back(found.box.y1 - box.y1);
  EXPECT_NEAR(std::sqrt(1.0 + 16.0), momentsOf(top).deviation, 4 * 4.12 / 89.4);
}

TEST_F(Detector, MissesMoreOfWhatIsHidden)
{
  DetectorOptions options = faultless();
  options.missRate = 0.1;
  options.occludedMissRate = 0.5;
  options.minVisible = 0.2;
  for (const auto& [share, rate] : {
           std::pair{1.0, 0.1},
           {0.6, 0.3},
           {0.2, 0.5}
  })
  {
    const double missed = 4000 - static_cast<double>(detections(options, 4000, share).size());
    EXPECT_NEAR(rate, missed / 4000, 4 * std::sqrt(rate * (1 - rate) / 4000));
  }
}

TEST_F(Detector, LabelsFlipToWhatTheTableCallsSimilar)
{
  DetectorOptions options = faultless();
  options.flipRate = 0.2;
  const auto similar = labels.properties("chair").confusedWith;
  ASSERT_FALSE(similar.empty());
  double flips = 0;
  for (const auto& found : detections(options, 4000))
  {
    if (found.label == "chair") continue;
    ++flips;
    EXPECT_NE(similar.end(), std::find(similar.begin(), similar.end(), found.label));
  }
  EXPECT_NEAR(0.2, flips / 4000, 4 * std::sqrt(0.2 * 0.8 / 4000));
}

TEST_F(Detector, FalseAlarmsHaveTheirRateAndLieInTheImage)
{
  DetectorOptions options = faultless();
  options.falseAlarms = 1.3;
  const auto found = detections(options, 2000);
  EXPECT_NEAR(2000 * 2.3, static_cast<double>(found.size()), 4 * std::sqrt(2000 * 0.3 * 0.7));
  for (const auto& alarm : found)
  {
    EXPECT_TRUE(alarm.box.isValid());
    EXPECT_GE(alarm.box.x1, 0);
    EXPECT_GE(alarm.box.y1, 0);
    EXPECT_LE(alarm.box.x2, 639);
    EXPECT_LE(alarm.box.y2, 479);
    EXPECT_TRUE(alarm.label == "chair" || alarm.label == "cup") << alarm.label;
  }
}

}  // namespace
}  // namespace quadmap::simulator
