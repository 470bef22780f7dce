#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "quadmap/folders/FolderKinds.h"
#include "quadmap/odometry/VisualOdometry.h"
#include "quadmap/simulator/Simulator.h"

// Time of visual odometry per 640x480 image, on one core: images are in memory, one after the
// other.

namespace
{
using namespace quadmap;
using Scans = std::vector<mrpt::obs::CObservation3DRangeScan::Ptr>;

constexpr std::size_t kFrames = 60;  // 1.5 MB each

/** The start of the walk of which the bundled recording is made, in 640x480. */
Scans simulatedScans()
{
  const simulator::Simulator room(
      simulator::readScene(simulator::findScene("home")), LabelTable::installed(), 1);
  Scans scans;
  for (std::size_t i = 0; i < kFrames / 3; ++i) scans.push_back(room.frame(i).scan);
  return scans;
}

/** The start of a recording in the layout of TUM RGB-D; none when it is not there. */
Scans recordedScans(const std::string& name)
{
  const char* fromUser = std::getenv("QUADMAP_TEST_DATA");
  const std::string root =
      fromUser ? fromUser : std::string(QUADMAP_SOURCE_DIR) + "/../shared/data";
  Scans scans;
  if (!std::filesystem::is_directory(root + "/" + name)) return scans;
  const FrameFolder dataset = openFrameFolder("tum", root + "/" + name);
  for (std::size_t i = 0; i < dataset.frames().size() && i < kFrames; ++i)
    scans.push_back(dataset.scan(i));
  return scans;
}

void follow(benchmark::State& state, const Scans& scans)
{
  if (scans.empty()) return state.SkipWithError("recording not found");
  std::size_t frames = 0, failed = 0;
  for (auto _ : state)
  {
    VisualOdometry odometry({});
    for (const auto& scan : scans) benchmark::DoNotOptimize(odometry.add(*scan));
    frames += scans.size();
    failed += odometry.counts().failed;
  }
  state.counters["time_per_frame"] = benchmark::Counter(
      static_cast<double>(frames), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["failed_share"] = static_cast<double>(failed) / static_cast<double>(frames);
}

}  // namespace

int main(int argc, char** argv)
try
{
  cv::setNumThreads(1);
  benchmark::Initialize(&argc, argv);
  const Scans home = simulatedScans(), kitchen = recordedScans("kitchen_a"),
              cabinet = recordedScans("tum_fr3_cabinet");
  benchmark::RegisterBenchmark("home, simulated", follow, home)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("kitchen_a", follow, kitchen)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("tum_fr3_cabinet", follow, cabinet)->Unit(benchmark::kMillisecond);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
catch (const std::exception& e)
{
  std::cerr << "benchmark_visual_odometry: " << e.what() << "\n";
  return 1;
}
