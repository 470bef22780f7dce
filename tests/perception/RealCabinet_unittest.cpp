#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../obs/TestData.h"
#include "quadmap/folders/FolderKinds.h"
#include "quadmap/geometry/Overlap.h"
#include "quadmap/geometry/RobustStatistics.h"
#include "quadmap/obs/ObjectList.h"
#include "quadmap/perception/RoomPerception.h"

using namespace quadmap;

namespace
{
/** Shape IoU with the sides of the truth that face as those of the measurement do. */
double shapeIoU(const Ellipsoid& measured, const Ellipsoid& truth)
{
  const Eigen::Matrix3d turn = measured.rotation().transpose() * truth.rotation();
  Eigen::Vector3d sizes = truth.semiAxes();
  if (std::abs(turn(0, 0)) < std::abs(turn(0, 1))) std::swap(sizes.x(), sizes.y());
  return alignedIoU(measured.semiAxes(), sizes);
}
}  // namespace

// Every frame of a real recording by itself: no map smooths what a measurement claims.
TEST(RealCabinet, EachCompleteMeasurementHasItsShape)
{
  const auto recording = testData("tum_fr3_cabinet");
  if (recording.empty()) GTEST_SKIP() << "recording tum_fr3_cabinet is not there";
  const FrameFolder dataset = openFrameFolder("tum", recording);
  const auto truth = readObjectsJson(recording + "/objects_gt.json").at(0);
  RoomPerception perception(PerceptionOptions(), LabelTable::installed());
  std::vector<double> shapes;
  for (std::size_t i = 0; i < dataset.frames().size(); ++i)
  {
    const auto boxes = dataset.boxes(i);
    const auto T_world_robot = dataset.T_world_robot(i);
    if (!boxes || !T_world_robot) continue;
    const auto scan = dataset.scan(i);
    const auto T_world_sensor = *T_world_robot + scan->sensorPose;
    perception.measure(*scan, *boxes, T_world_sensor);
    for (const auto& object : boxes->objects)
    {
      if (!object.measurement.complete) continue;
      const Ellipsoid measured =
          object.measurement.complete->object_sensor.transformed(T_world_sensor);
      shapes.push_back(shapeIoU(measured, truth.object));
    }
  }
  EXPECT_GT(shapes.size(), dataset.frames().size() / 2);
  EXPECT_GE(quantile(shapes, 0.5), 0.9);
  EXPECT_GE(quantile(shapes, 0.0), 0.6);
}
