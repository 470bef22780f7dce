#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include "SyntheticFrame.h"
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
  frame.add(2.2, -0.75, 0, 0.9, {0.4, 0.35, 0.3});   // beside it
  return frame;
}
}  // namespace

class CameraRoll : public testing::TestWithParam<double>
{
};

TEST_P(CameraRoll, DoesNotMatter)
{
  const SyntheticFrame frame = tableFrame(mrpt::DEG2RAD(GetParam()));
  auto boxes = frame.observation({frame.detect(1, "microwave"), frame.detect(2, "suitcase")});
  FramePerception(PerceptionOptions(), LabelTable::installed())
      .measure(frame.scan(), boxes, frame.up_sensor());
  for (std::size_t i = 0; i < 2; ++i)
  {
    const Ellipsoid& truth = frame.boxes[i + 1].cuboid;
    const auto& measurement = boxes.objects[i].measurement;
    ASSERT_TRUE(measurement.complete) << i << ": " << measurement.reason;
    const Ellipsoid measured =
        measurement.complete->object_sensor.transformed(frame.T_world_sensor);
    EXPECT_EQ(measurement.complete->faces[5].kind, FaceKind::Support) << i;
    EXPECT_LT((measured.center() - truth.center()).norm(), 0.02) << i;
    EXPECT_NEAR(measured.semiAxes().z(), truth.semiAxes().z(), 0.01) << i;
    EXPECT_GT(measured.rotation()(2, 2), 0.999) << i << ": z is up";
  }
}

INSTANTIATE_TEST_SUITE_P(Mounted, CameraRoll, testing::Values(0, 90, -90, 180, 30, -45));
