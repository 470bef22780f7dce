#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "quadmap/perception/FramePerception.h"
#include "quadmap/sensors/TumDataset.h"
#include "quadmap/sensors/simulator/Simulator.h"

// Time of FramePerception per frame, on one core: frames are in memory, the result is thrown away.

namespace
{
using namespace quadmap;

/** A frame as the pipeline hands it to perception. */
struct Frame
{
  mrpt::obs::CObservation3DRangeScan::Ptr scan;
  CObservationObjects boxes;
  Eigen::Vector3d up_sensor;
};
using Frames = std::vector<Frame>;

constexpr std::size_t kMaxFrames = 60;  // 640x480 with colour: 1.5 MB each

void addFrame(
    Frames& frames,
    const mrpt::obs::CObservation3DRangeScan::Ptr& scan,
    const CObservationObjects::Ptr& boxes,
    const std::optional<mrpt::poses::CPose3D>& T_world_robot)
{
  if (!boxes || boxes->objects.empty() || !T_world_robot) return;
  const auto T_world_sensor = *T_world_robot + scan->sensorPose;
  const Eigen::Vector3d up_sensor =
      T_world_sensor.getRotationMatrix().asEigen().transpose() * Eigen::Vector3d::UnitZ();
  frames.push_back({scan, *boxes, up_sensor});
}

/** Spread over the walk of which the bundled recording is made, in 640x480. */
Frames simulatedFrames()
{
  const simulator::Simulator room(
      simulator::readScene(simulator::findScene("home")), LabelTable::installed(), 1);
  Frames frames;
  constexpr std::size_t kFrames = 20;  // ray casting takes its time
  for (std::size_t i = 0; i < kFrames; ++i)
  {
    const std::size_t index = i * room.frameCount() / kFrames;
    const auto frame = room.frame(index);
    addFrame(frames, frame.scan, frame.objects, room.truePoses()[index]);
  }
  return frames;
}

/** Spread over a recording in the layout of TUM RGB-D; none when it is not there. */
Frames recordedFrames(const std::string& name)
{
  const char* fromUser = std::getenv("QUADMAP_TEST_DATA");
  const std::string root =
      fromUser ? fromUser : std::string(QUADMAP_SOURCE_DIR) + "/../shared/data";
  Frames frames;
  if (!std::filesystem::is_directory(root + "/" + name)) return frames;
  const TumDataset dataset(root + "/" + name);
  const std::size_t step = dataset.frames().size() / kMaxFrames + 1;
  for (std::size_t i = 0; i < dataset.frames().size(); i += step)
    addFrame(frames, dataset.scan(i), dataset.boxes(i), dataset.T_world_robot(i));
  return frames;
}

void measureFrames(benchmark::State& state, const Frames& frames)
{
  const FramePerception perception(PerceptionOptions(), LabelTable::installed());
  std::size_t next = 0, boxes = 0;
  for (auto _ : state)
  {
    const Frame& frame = frames[next++ % frames.size()];
    CObservationObjects measured = frame.boxes;
    perception.measure(*frame.scan, measured, frame.up_sensor);
    benchmark::DoNotOptimize(measured.objects.data());
    boxes += measured.objects.size();
  }
  state.counters["boxes/frame"] =
      static_cast<double>(boxes) / static_cast<double>(state.iterations());
}

void registerFrames(const std::string& name, const Frames& frames)
{
  if (frames.empty())
    std::cerr << "no frames of " << name << ": left out\n";
  else
    benchmark::RegisterBenchmark(("perception/" + name).c_str(), measureFrames, frames)
        ->Unit(benchmark::kMillisecond);
}
}  // namespace

int main(int argc, char** argv)
try
{
  benchmark::Initialize(&argc, argv);
  registerFrames("simulated_home", simulatedFrames());
  registerFrames("tum_fr3_cabinet", recordedFrames("tum_fr3_cabinet"));
  registerFrames("kitchen_a", recordedFrames("kitchen_a"));
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
catch (const std::exception& e)
{
  std::cerr << "benchmark_perception: " << e.what() << "\n";
  return 1;
}
