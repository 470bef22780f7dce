#include "detector/ViewErrors.h"

#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <set>

#include "../SceneFixture.h"

namespace quadmap::simulator
{
namespace
{
/** The camera at a bearing from the object [deg], 2 m away unless said. */
Eigen::Vector3d eyeAt(double bearing_deg, double distance = 2)
{
  const double a = mrpt::DEG2RAD(bearing_deg);
  return {distance * std::cos(a), distance * std::sin(a), 0};
}

TEST(ViewErrors, StayWhileTheViewStays)
{
  DetectorOptions options = faultless();
  options.viewEdges = 0.02;
  const auto edge = [&](double bearing, double distance = 2)
  { return viewErrors(options, 1, 3, eyeAt(bearing, distance)).edges[0]; };
  std::set<double> different;
  for (double bearing = -179; bearing < 180; bearing += 0.5) different.insert(edge(bearing));
  EXPECT_NEAR(360 / options.viewAngle_deg, static_cast<double>(different.size()), 1);
  std::set<double> near;
  for (double distance = 1; distance < 4; distance *= 1.01) near.insert(edge(10, distance));
  EXPECT_NEAR(std::log(4) / std::log(1.35), static_cast<double>(near.size()), 1.5);
  EXPECT_NE(edge(10), viewErrors(options, 2, 3, eyeAt(10)).edges[0]) << "another seed";
  EXPECT_NE(edge(10), viewErrors(options, 1, 4, eyeAt(10)).edges[0]) << "another object";
}

TEST(ViewErrors, EdgesHaveLongTails)
{
  DetectorOptions options = faultless();
  options.viewEdges = 0.01;
  int beyond3 = 0, beyond1 = 0, count = 0;
  for (std::size_t object = 0; object < 5000; ++object)
    for (const double edge : viewErrors(options, 1, object, eyeAt(0)).edges)
      ++count, beyond3 += std::abs(edge) > 0.03 ? 1 : 0, beyond1 += std::abs(edge) > 0.01 ? 1 : 0;
  // Student's t with three degrees of freedom: 39.1 % beyond 1, 5.77 % beyond 3 (Gaussian: 0.27 %).
  EXPECT_NEAR(0.391, static_cast<double>(beyond1) / count, 0.015);
  EXPECT_NEAR(0.0577, static_cast<double>(beyond3) / count, 0.007);
}

TEST(ViewErrors, HappenInTheirShareOfViews)
{
  DetectorOptions options = faultless();
  options.viewMisses = 0.1;
  options.viewFlips = 0.2;
  options.viewParts = 0.3;
  options.viewMergers = 0.4;
  double misses = 0, flips = 0, parts = 0, mergers = 0;
  constexpr int kViews = 4000;
  for (std::size_t object = 0; object < kViews; ++object)
  {
    const ViewErrors e = viewErrors(options, 1, object, eyeAt(0));
    misses += e.isMissed;
    flips += e.wrongLabel.has_value();
    parts += e.cut.sum() > 0;
    mergers += e.isMerged;
    EXPECT_LE(e.cut.sum(), 0.6);
  }
  const double tolerance = 4 * 0.5 / std::sqrt(kViews);
  EXPECT_NEAR(0.1, misses / kViews, tolerance);
  EXPECT_NEAR(0.2, flips / kViews, tolerance);
  EXPECT_NEAR(0.3, parts / kViews, tolerance);
  EXPECT_NEAR(0.4, mergers / kViews, tolerance);
}

class DetectorWithViews : public ::testing::Test
{
 protected:
  std::vector<DetectedObject> boxesOf(
      const std::string& objects, const DetectorOptions& options, std::uint64_t seed = 1)
  {
    const Scene scene = sceneFromText(kRoomText + objects);
    const PinholeCamera camera = CameraOptions().pinhole();
    const auto frame = RayCaster(scene, camera).render(lookingAhead());
    visible = visibleObjects(scene, frame, options);
    const LabelTable labels = LabelTable::installed();
    RandomStream random(1, Purpose::Detector, 0);
    return SimulatedDetector(scene, options, labels, seed).detect(visible, camera, random).boxes;
  }
  std::vector<VisibleObject> visible;
};

const std::string kTwoChairs =
    "[object a]\nlabel = chair\nposition = 2 0.25 0\npart1 = box 0 0 1.2 0.4 0.4 0.8 grey\n"
    "[object b]\nlabel = chair\nposition = 2 -0.25 0\npart1 = box 0 0 1.2 0.4 0.4 0.8 grey\n";

TEST_F(DetectorWithViews, MergesNeighboursOfOneLabel)
{
  DetectorOptions options = faultless();
  EXPECT_EQ(2U, boxesOf(kTwoChairs, options).size());
  options.viewMergers = 1;
  const auto boxes = boxesOf(kTwoChairs, options);
  ASSERT_GE(boxes.size(), 1U);
  EXPECT_NEAR(std::min(visible[0].box.x1, visible[1].box.x1), boxes[0].box.x1, 1e-9);
  EXPECT_NEAR(std::max(visible[0].box.x2, visible[1].box.x2), boxes[0].box.x2, 1e-9);

  std::string chairAndTable = kTwoChairs;
  chairAndTable.replace(chairAndTable.find("label = chair"), 13, "label = tv");
  const auto apart = boxesOf(chairAndTable, options);
  ASSERT_EQ(2U, apart.size()) << "other labels are not merged";
  EXPECT_NEAR(visible[0].box.x2, apart[0].box.x2, 1e-9);
}

TEST_F(DetectorWithViews, TwoThatMergeDoNotHideEachOther)
{
  DetectorOptions options = faultless();
  options.viewMergers = 1;
  std::set<std::size_t> counts;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    counts.insert(boxesOf(kTwoChairs, options, seed).size());
  EXPECT_EQ((std::set<std::size_t>{1, 2}), counts);
}

TEST_F(DetectorWithViews, BoxesAPartAndSaysAnotherLabel)
{
  DetectorOptions options = faultless();
  options.viewParts = 1;
  const auto parts = boxesOf(kTwoChairs, options);
  ASSERT_EQ(2U, parts.size());
  for (std::size_t i = 0; i < 2; ++i)
  {
    const double share = parts[i].box.area() / visible[i].box.area();
    EXPECT_GT(share, 0.38);
    EXPECT_LT(share, 0.77);
  }
  options = faultless();
  options.viewFlips = 1;
  const auto confused = LabelTable::installed().properties("chair").confusedWith;
  for (const auto& box : boxesOf(kTwoChairs, options))
    EXPECT_EQ(1, std::count(confused.begin(), confused.end(), box.label)) << box.label;
  options.viewMisses = 1;
  EXPECT_TRUE(boxesOf(kTwoChairs, options).empty());
}

}  // namespace
}  // namespace quadmap::simulator
