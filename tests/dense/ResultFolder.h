#pragma once

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <nlohmann/json.hpp>
#include <string>

#include "../obs/TemporaryFolder.h"
#include "../slam/SyntheticRoom.h"
#include "quadmap/obs/ObjectList.h"

namespace quadmap::testing
{
/** A folder as quadmap-slam writes it, of a camera that drove around a cuboid on a floor: depth and
 * boxes without noise, every edge of a box usable. The cuboid is object 7. */
class ResultFolder
{
 public:
  explicit ResultFolder(const SyntheticRoom& room = {}, int keyframes = 16) : room_(room)
  {
    mrpt::maps::CSimpleMap scans, boxes;
    nlohmann::json associations = nlohmann::json::array();
    for (int i = 0; i < keyframes; ++i)
    {
      const double time = 100.0 + i;
      const auto T_map_robot = room.robotAt(2 * M_PI * i / keyframes);
      const auto scan = room.scanFrom(T_map_robot, time);
      add(scans, T_map_robot, scan);
      const auto seen = room.boxesOf(*scan, T_map_robot);
      seen->objects[0].measurement.kind = MeasurementKind::Partial;
      seen->objects[0].measurement.edges.emplace();
      add(boxes, T_map_robot, seen);
      associations.push_back({
          {"sensor",       room.sensor},
          {  "time",              time},
          { "boxes", {{{"object", 7}}}}
      });
    }
    EXPECT_TRUE(scans.saveToFile(folder_.path("map.simplemap")));
    EXPECT_TRUE(boxes.saveToFile(folder_.path("objects.simplemap")));
    folder_.write(
        "report.json",
        nlohmann::json{
            {"associations", associations}
    }
            .dump());
  }

  std::string path() const { return folder_.folder().string(); }
  const TemporaryFolder& folder() const { return folder_; }

  /** The object as a poor map might have it: shifted, and too small. */
  ObjectRecord record() const
  {
    ObjectRecord record;
    record.id = "7";
    record.label = room_.label;
    const mrpt::poses::CPose3D shift(0.05, -0.04, 0.03, 0, 0, 0);
    record.object = Ellipsoid(shift + room_.box.pose(), 0.7 * room_.box.semiAxes());
    return record;
  }

 private:
  static void add(
      mrpt::maps::CSimpleMap& map,
      const mrpt::poses::CPose3D& T_map_robot,
      const mrpt::obs::CObservation::Ptr& observation)
  {
    mrpt::obs::CSensoryFrame frame;
    frame.insert(observation);
    map.insert(mrpt::poses::CPose3DPDFGaussian(T_map_robot), frame);
  }

  SyntheticRoom room_;
  TemporaryFolder folder_;
};

}  // namespace quadmap::testing
