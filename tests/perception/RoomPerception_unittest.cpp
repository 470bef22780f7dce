#include "quadmap/perception/RoomPerception.h"

#include <gtest/gtest.h>

#include "../surfaces/SyntheticFrame.h"

namespace quadmap
{
TEST(RoomPerception, MeasuresWithTheSurfacesOfEarlierFrames)
{
  const LabelTable labels;
  SyntheticFrame frame;
  frame.add(1.8, 0, 0, 0.3, {0.5, 0.4, 0.5});
  const auto scan = frame.scan();
  CObservationObjects inRoom = frame.observation({frame.detect(0, "box")}), alone = inRoom;
  FramePerception(PerceptionOptions(), labels).measure(scan, alone, frame.up_sensor());
  RoomPerception perception(PerceptionOptions(), labels);
  EXPECT_FALSE(perception.room().floorHeight());

  for (int i = 0; i < 5; ++i) perception.measure(scan, inRoom, frame.T_world_sensor);

  ASSERT_TRUE(perception.room().floorHeight());
  EXPECT_NEAR(*perception.room().floorHeight(), 0.0, 0.01);
  ASSERT_EQ(alone.objects[0].measurement.kind, MeasurementKind::Complete);
  EXPECT_EQ(inRoom.objects[0].measurement.kind, MeasurementKind::Complete);
}

}  // namespace quadmap
