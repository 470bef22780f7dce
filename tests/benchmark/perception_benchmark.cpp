#include <benchmark/benchmark.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "quadmap/folders/FolderKinds.h"
#include "quadmap/geometry/RobustStatistics.h"
#include "quadmap/perception/FramePerception.h"
#include "quadmap/perception/RoomPerception.h"
#include "quadmap/simulator/Simulator.h"

// Time and memory of FramePerception per frame, on one core: frames are in memory, the result is
// thrown away.

namespace
{
using namespace quadmap;

/** A frame as the pipeline hands it to perception. */
struct Frame
{
  mrpt::obs::CObservation3DRangeScan::Ptr scan;
  CObservationObjects boxes;
  mrpt::poses::CPose3D T_world_sensor;

  Eigen::Vector3d up_sensor() const
  {
    return T_world_sensor.getRotationMatrix().asEigen().row(2).transpose();
  }
};
using Frames = std::vector<Frame>;

constexpr std::size_t kMaxFrames = 120;  // 640x480 with colour: 1.5 MB each
constexpr std::size_t kBoxes = 5;        // in each frame
constexpr int kPasses = 5;               // over all frames
constexpr int kManyFrames = 10000;
constexpr int kLooksAtMemory[] = {1000, 5000, kManyFrames};  // after so many frames

void addFrame(
    Frames& frames,
    const mrpt::obs::CObservation3DRangeScan::Ptr& scan,
    const CObservationObjects::Ptr& boxes,
    const std::optional<mrpt::poses::CPose3D>& T_world_robot)
{
  if (!boxes || boxes->objects.empty() || !T_world_robot) return;
  frames.push_back({scan, *boxes, *T_world_robot + scan->sensorPose});
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
  const FrameFolder dataset = openFrameFolder("tum", root + "/" + name);
  const std::size_t step = dataset.frames().size() / kMaxFrames + 1;
  for (std::size_t i = 0; i < dataset.frames().size(); i += step)
    addFrame(frames, dataset.scan(i), dataset.boxes(i), dataset.T_world_robot(i));
  return frames;
}

/** The surest boxes of each frame; too few are repeated, a few pixels aside. */
Frames withFiveBoxes(Frames frames)
{
  for (Frame& frame : frames)
  {
    auto& objects = frame.boxes.objects;
    std::stable_sort(
        objects.begin(), objects.end(),
        [](const auto& a, const auto& b) { return a.score > b.score; });
    const std::size_t own = objects.size();
    objects.reserve(kBoxes);
    while (objects.size() < kBoxes)
    {
      constexpr double kAside = 7;  // [px]
      objects.push_back(objects[objects.size() - own]);
      for (double* x : {&objects.back().box.x1, &objects.back().box.x2}) *x += kAside;
    }
    objects.resize(kBoxes);
  }
  return frames;
}

/** Every second pixel of every second row. */
Frames halved(Frames frames)
{
  for (Frame& frame : frames)
  {
    auto half = mrpt::obs::CObservation3DRangeScan::Create(*frame.scan);
    auto& camera = half->cameraParams;
    camera.setIntrinsicParamsFromValues(
        camera.fx() / 2, camera.fy() / 2, camera.cx() / 2, camera.cy() / 2);
    camera.ncols /= 2;
    camera.nrows /= 2;
    const auto full = frame.scan->rangeImage;
    half->hasIntensityImage = false;
    half->rangeImage_setSize(static_cast<int>(camera.nrows), static_cast<int>(camera.ncols));
    for (int v = 0; v < static_cast<int>(camera.nrows); ++v)
      for (int u = 0; u < static_cast<int>(camera.ncols); ++u)
        half->rangeImage(v, u) = full(2 * v, 2 * u);
    frame.scan = half;
    frame.boxes.cameraParams = camera;
    for (auto& object : frame.boxes.objects)
      object.box = {object.box.x1 / 2, object.box.y1 / 2, object.box.x2 / 2, object.box.y2 / 2};
  }
  return frames;
}

double threadTime_ms()
{
  timespec t{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/** Allocated and not freed in this process [kB]; all of malloc, whoever called it. */
double liveMemory_kb()
{
  const auto info = ::mallinfo2();
  return 1e-3 * static_cast<double>(info.uordblks + info.hblkhd);
}

/** What of this process is in memory [kB]. */
double residentMemory_kb()
{
  std::ifstream file("/proc/self/statm");
  double pages = 0, residentPages = 0;
  file >> pages >> residentPages;
  return 1e-3 * residentPages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

void measureFrames(benchmark::State& state, const Frames& frames)
{
  const FramePerception perception(PerceptionOptions(), LabelTable::installed());
  std::size_t next = 0;
  std::vector<double> times_ms;
  times_ms.reserve(frames.size() * kPasses);
  for (auto _ : state)
  {
    const Frame& frame = frames[next++ % frames.size()];
    CObservationObjects measured = frame.boxes;
    const Eigen::Vector3d up_sensor = frame.up_sensor();
    const double start_ms = threadTime_ms();
    perception.measure(*frame.scan, measured, up_sensor);
    times_ms.push_back(threadTime_ms() - start_ms);
    benchmark::DoNotOptimize(measured.objects.data());
  }
  double sum_ms = 0;
  for (const double t : times_ms) sum_ms += t;
  state.counters["mean_ms"] = sum_ms / static_cast<double>(times_ms.size());
  state.counters["p95_ms"] = quantile(times_ms, 0.95);
}

/** Memory after some of the frames, with the surfaces of the room that they show: allocated, and
 * resident. */
void measureMemory(benchmark::State& state, const Frames& frames)
{
  RoomPerception perception(PerceptionOptions(), LabelTable::installed());
  int done = 0;
  for (auto _ : state)
  {
    const Frame& frame = frames[static_cast<std::size_t>(done) % frames.size()];
    CObservationObjects measured = frame.boxes;
    perception.measure(*frame.scan, measured, frame.T_world_sensor);
    ++done;
    for (const int look : kLooksAtMemory)
      if (done == look)
      {
        state.counters["live_kB_" + std::to_string(look)] = liveMemory_kb();
        state.counters["resident_kB_" + std::to_string(look)] = residentMemory_kb();
      }
  }
}

void registerFrames(const std::string& name, const Frames& frames)
{
  if (frames.empty())
  {
    std::cerr << "no frames of " << name << ": left out\n";
    return;
  }
  const auto add = [](const std::string& title, auto measure, const Frames& f, int iterations)
  {
    benchmark::RegisterBenchmark(title.c_str(), measure, f)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(iterations);
  };
  const Frames full = withFiveBoxes(frames), half = halved(full);
  const int iterations = kPasses * static_cast<int>(full.size());
  add("perception/640x480/" + name, measureFrames, full, iterations);
  add("perception/320x240/" + name, measureFrames, half, iterations);
  add("memory/320x240/" + name, measureMemory, half, kManyFrames);
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
