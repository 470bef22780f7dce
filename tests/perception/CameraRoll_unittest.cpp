#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <vector>

#include "../surfaces/SyntheticFrame.h"
#include "quadmap/perception/FramePerception.h"

using namespace quadmap;

namespace
{
/** Things on a table and on the floor, by a camera that is turned about its optical axis. */
SyntheticFrame tableFrame(double roll)
{
  SyntheticFrame frame;
  frame.T_world_sensor = mrpt::poses::CPose3D(0, 0, 1.5, 0, 0.5, roll);
  frame.noise = 0.001;
  frame.add(2.0, 0, 0, 0.3, {0.8, 0.9, 0.7});        // the table
  frame.add(1.85, 0.1, 0.7, 0.5, {0.3, 0.25, 0.2});  // on it
  frame.add(2.2, -0.95, 0, 0.9, {0.4, 0.35, 0.3});   // beside it, not hidden
  return frame;
}
/** What perception makes of both things, in the world. */
std::vector<CompleteMeasurement> measureWith(double roll)
{
  const SyntheticFrame frame = tableFrame(roll);
  auto boxes = frame.observation({frame.detect(1, "microwave"), frame.detect(2, "suitcase")});
  FramePerception(PerceptionOptions(), LabelTable::installed())
      .measure(frame.scan(), boxes, frame.up_sensor());
  std::vector<CompleteMeasurement> measured;
  for (const auto& object : boxes.objects)
  {
    const auto& complete = object.measurement.complete;
    EXPECT_TRUE(complete) << object.label << ": " << object.measurement.reason;
    if (!complete) continue;
    measured.push_back(*complete);
    measured.back().object_sensor = complete->object_sensor.transformed(frame.T_world_sensor);
  }
  return measured;
}
}  // namespace

TEST(CameraRoll, DoesNotMatter)
{
  const SyntheticFrame world = tableFrame(0);
  const auto level = measureWith(0);
  ASSERT_EQ(level.size(), 2u);
  for (const double roll_deg : {90.0, -90.0, 180.0, 30.0})
  {
    SCOPED_TRACE(roll_deg);
    const auto rolled = measureWith(mrpt::DEG2RAD(roll_deg));
    ASSERT_EQ(rolled.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i)
    {
      const Ellipsoid &a = level[i].object_sensor, &b = rolled[i].object_sensor;
      // The noise of the depth falls on other pixels; sides nobody sees differ from the truth alike
      EXPECT_LT((a.center() - b.center()).norm(), 0.01) << i;
      EXPECT_NEAR(b.semiAxes().z(), world.boxes[i + 1].cuboid.semiAxes().z(), 0.01) << i;
      EXPECT_GT(b.rotation()(2, 2), 0.999) << i << ": z is up";
      EXPECT_EQ(rolled[i].faces[5].kind, FaceKind::Support) << i;
    }
  }
}
