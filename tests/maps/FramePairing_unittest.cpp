#include "quadmap/maps/FramePairing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../slam/SeveralCameras.h"
#include "quadmap/geometry/Overlap.h"
#include "quadmap/maps/CQuadricObjectMap.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
constexpr int kMoments = 5;
const UncertainPose kExact(CPose3D(), {0, 0});

CPose3D poseAt(int moment) { return fourCameras()[0].robotAt(0.3 * moment); }

/** What three cameras and their detectors say at one moment: first the scans, then the boxes. */
std::vector<mrpt::obs::CObservation::Ptr> observationsAt(int moment)
{
  std::vector<mrpt::obs::CObservation::Ptr> scans, boxes;
  const auto cameras = fourCameras();
  for (std::size_t c = 0; c < 3; ++c)
  {
    scans.push_back(cameras[c].scanFrom(poseAt(moment), kStart + moment));
    boxes.push_back(cameras[c].boxesOf(
        dynamic_cast<mrpt::obs::CObservation3DRangeScan&>(*scans.back()), poseAt(moment)));
  }
  scans.insert(scans.end(), boxes.begin(), boxes.end());
  return scans;
}
}  // namespace

TEST(FramePairing, SensorsInAnyOrderGiveTheSameMap)
{
  const Ellipsoid truth = SyntheticRoom().box;
  std::mt19937 random(1);
  for (int trial = 0; trial < 3; ++trial)
  {
    CQuadricObjectMap map;
    for (int i = 0; i < kMoments; ++i)
    {
      auto observations = observationsAt(i);
      if (trial > 0) std::shuffle(observations.begin(), observations.end(), random);
      for (const auto& o : observations) map.insertObservation(*o, poseAt(i));
    }
    map.consolidate();
    ASSERT_EQ(map.confirmedObjects().size(), 1u) << map.asString();
    const MapObject& object = *map.confirmedObjects()[0];
    EXPECT_EQ(object.observations(), 3u * kMoments) << "every pair was found";
    // Exact depths and boxes: what is left is the pixel grid
    EXPECT_LT((object.object.center() - truth.center()).norm(), 0.02);
    EXPECT_GT(cuboidIoU(object.object, truth), 0.88);
  }
}

TEST(FramePairing, ManySensorsMayWaitForTheirBoxes)
{
  FramePairing pairing;
  for (int c = 0; c < 10; ++c) EXPECT_FALSE(pairing.add(*sampleScan(kStart, std::to_string(c))));
  for (int c = 0; c < 10; ++c)
    EXPECT_TRUE(pairing.add(*sampleBoxes(kStart, std::to_string(c)), kExact)) << c;
  EXPECT_FALSE(pairing.add(*sampleBoxes(kStart, "0"), kExact)) << "each scan serves once";
  for (int i = 0; i < 100; ++i) pairing.add(*sampleScan(kStart + i, "camera"));
  EXPECT_FALSE(pairing.add(*sampleBoxes(kStart, "camera"), kExact)) << "memory is bounded";
}

TEST(FramePairing, RefusesPairsThatCannotBelongTogether)
{
  const SyntheticRoom room;
  const auto scan = room.scanFrom(poseAt(0), kStart);
  const auto good = room.boxesOf(*scan, poseAt(0));
  CObservationObjects moved = *good, zoomed = *good, scaled = *good, bent = *good;
  moved.sensorPose = moved.sensorPose + CPose3D(0, 0.1, 0, 0, 0, 0);
  zoomed.cameraParams.fx(zoomed.cameraParams.fx() * 2);
  scaled.cameraParams.ncols *= 2;
  bent.cameraParams.distortion = mrpt::img::DistortionModel::plumb_bob;
  bent.cameraParams.dist[0] = 0.1;
  for (const auto& [wrong, expected] : {
           std::pair{ moved,  "sensorPose"},
           {zoomed, "calibration"},
           {scaled,       "image"},
           {  bent,  "distortion"}
  })
    for (const bool scanFirst : {true, false})
    {
      CQuadricObjectMap map;
      const std::vector<const mrpt::obs::CObservation*> frame = {scan.get(), &wrong};
      map.insertObservation(*frame[scanFirst ? 0 : 1], poseAt(0));
      try
      {
        map.insertObservation(*frame[scanFirst ? 1 : 0], poseAt(0));
        ADD_FAILURE() << expected << " was not looked at";
      }
      catch (const std::invalid_argument& e)
      {
        const std::string text = e.what();
        EXPECT_NE(text.find("\"camera\""), std::string::npos) << text;
        EXPECT_NE(text.find(expected), std::string::npos) << text;
      }
      EXPECT_TRUE(map.isEmpty());
      map.insertObservation(*scan, poseAt(0));
      EXPECT_TRUE(map.insertObservation(*good, poseAt(0))) << "the wrong pair is forgotten";
    }
}

TEST(FramePairing, RefusesACalibrationThatIsNone)
{
  const SyntheticRoom room;
  const auto good = room.scanFrom(poseAt(0), kStart);
  auto offCentre = *good, ofAnotherSize = *good;
  offCentre.cameraParams.cy(std::nan(""));
  ofAnotherSize.cameraParams.ncols *= 2;
  for (const auto& [scan, expected] : {
           std::pair{    offCentre, "no usable calibration"},
           {ofAnotherSize, "has a calibration for"}
  })
  {
    CQuadricObjectMap map;
    auto boxes = *room.boxesOf(*good, poseAt(0));
    boxes.cameraParams = scan.cameraParams;
    map.insertObservation(boxes, poseAt(0));
    try
    {
      map.insertObservation(scan, poseAt(0));
      ADD_FAILURE() << expected << " was not looked at";
    }
    catch (const std::exception& e)
    {
      const std::string text = e.what();
      EXPECT_NE(text.find("\"camera\""), std::string::npos) << text;
      EXPECT_NE(text.find(expected), std::string::npos) << text;
    }
    EXPECT_TRUE(map.isEmpty());
  }
}

TEST(FramePairing, AnEmptyListOfBoxesCountsAsAMiss)
{
  const SyntheticRoom room;
  CQuadricObjectMap map;
  for (int i = 0; i < kMoments; ++i)
  {
    const auto scan = room.scanFrom(poseAt(i), kStart + i);
    map.insertObservation(*scan, poseAt(i));
    map.insertObservation(*room.boxesOf(*scan, poseAt(i)), poseAt(i));
  }
  ASSERT_EQ(map.objects().size(), 1u);
  const auto before = map.objects().begin()->second;
  const auto scan = room.scanFrom(poseAt(2), kStart + 10);
  auto nothing = *room.boxesOf(*scan, poseAt(2));
  nothing.objects.clear();
  EXPECT_FALSE(map.insertObservation(nothing, poseAt(2)));
  EXPECT_EQ(map.objects().begin()->second.missCount, before.missCount) << "its scan is missing";
  map.insertObservation(*scan, poseAt(2));
  EXPECT_EQ(map.objects().begin()->second.missCount, before.missCount + 1);
  EXPECT_LT(map.objects().begin()->second.existenceLogOdds, before.existenceLogOdds);
}

TEST(FramePairing, AScanWithPixelLabelsIsItsOwnBoxes)
{
  const SyntheticRoom room;
  const auto labelled = [&]
  {
    auto scan = room.scanFrom(poseAt(0), kStart);
    scan->pixelLabels = std::make_shared<mrpt::obs::TPixelLabelInfo<1>>();
    scan->pixelLabels->setSize(240, 320);
    scan->pixelLabels->setLabelName(0, "suitcase");
    scan->pixelLabels->setLabelName(1, "ceiling");
    const ImageBox box = room.boxesOf(*scan, poseAt(0))->objects.at(0).box;
    for (int v = static_cast<int>(box.y1); v <= box.y2; ++v)
      for (int u = static_cast<int>(box.x1); u <= box.x2; ++u) scan->pixelLabels->setLabel(v, u, 0);
    scan->pixelLabels->setLabel(0, 0, 1);
    return scan;
  }();
  CQuadricObjectMap map;
  EXPECT_TRUE(map.insertObservation(*labelled, poseAt(0)));
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_EQ(map.objects().begin()->second.label(), "suitcase");
  EXPECT_EQ(map.unknownLabels(), (std::set<std::string>{"ceiling"}));

  auto boxes = *room.boxesOf(*labelled, poseAt(0));
  boxes.objects[0].label = "strange thing";
  CQuadricObjectMap withBoxes;
  EXPECT_FALSE(withBoxes.insertObservation(boxes, poseAt(0)));
  EXPECT_TRUE(withBoxes.insertObservation(*labelled, poseAt(0)));
  ASSERT_EQ(withBoxes.objects().size(), 1u);
  EXPECT_EQ(withBoxes.objects().begin()->second.label(), "strange thing") << "boxes go first";
  EXPECT_EQ(withBoxes.unknownLabels(), (std::set<std::string>{"strange thing"}));
  withBoxes.clear();
  EXPECT_TRUE(withBoxes.unknownLabels().empty());
}
