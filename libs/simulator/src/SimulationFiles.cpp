#include <algorithm>
#include <cmath>
#include <filesystem>
#include <future>
#include <thread>

#include "quadmap/base/OutputFile.h"
#include "quadmap/obs/Trajectory.h"
#include "quadmap/sensors/RawlogWriter.h"
#include "quadmap/simulator/Simulator.h"

namespace quadmap::simulator
{
namespace
{
/** NAME of NAME.rawlog or NAME.rawlog.gz, with the folder. */
std::string stemOf(const std::string& rawlog)
{
  std::filesystem::path path = rawlog;
  if (path.extension() == ".gz") path.replace_extension();
  if (path.extension() == ".rawlog") path.replace_extension();
  return path.string();
}

std::vector<ObjectRecord> truthOf(const Scene& scene, const std::vector<unsigned>& framesVisible)
{
  std::vector<ObjectRecord> truth;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
  {
    const SceneObject& object = scene.objects[i];
    if (object.label.empty() || !object.way.empty()) continue;
    ObjectRecord record;
    record.id = std::to_string(truth.size() + 1);
    record.label = object.label;
    record.object = object.truth();
    record.orientationDefined = object.orientationDefined;
    record.framesVisible = framesVisible[i];
    const double start = scene.options.trajectory.startTime;
    if (std::isfinite(object.from)) record.from = start + object.from;
    if (std::isfinite(object.to)) record.to = start + object.to;
    truth.push_back(std::move(record));
  }
  return truth;
}

/** Makes the next frames on several threads. They are in their order. */
std::vector<SimulatedFrame> makeFrames(
    const Simulator& simulator, std::size_t first, std::size_t last)
{
  std::vector<std::future<SimulatedFrame>> running;
  for (std::size_t i = first; i < last; ++i)
    running.push_back(
        std::async(std::launch::async, [&simulator, i] { return simulator.frame(i); }));
  std::vector<SimulatedFrame> frames;
  for (auto& frame : running) frames.push_back(frame.get());
  return frames;
}

/** Whether no earlier frame has the same time. Cameras without a delay share times and poses. */
bool isFirstOfItsTime(const Simulator& simulator, std::size_t frame)
{
  return frame == 0 || simulator.time(frame) > simulator.time(frame - 1);
}

void write(
    const Simulator& simulator,
    std::size_t index,
    const SimulatedFrame& frame,
    RawlogWriter& writer)
{
  if (isFirstOfItsTime(simulator, index))
  {
    const auto time = frame.scan->timestamp;
    writer.writePose(time, kOdometryLabel, simulator.odometry()[index]);
    writer.writePose(time, kGroundTruthLabel, simulator.truePoses()[index]);
  }
  writer.write(*frame.scan);
  if (!labelsPixels(simulator.scene().options.detector.output)) writer.write(*frame.objects);
}

std::string nameOf(const std::string& path)
{
  return std::filesystem::path(path).filename().string();
}
}  // namespace

SimulationFiles::SimulationFiles(const std::string& file) :
    rawlog(file),
    boxes(objectsFileOf(file)),
    truth(stemOf(file) + ".objects.gt.json"),
    trajectory(stemOf(file) + ".groundtruth.tum")
{
}

SimulationSummary simulateToFiles(
    const Simulator& simulator,
    const std::string& rawlog,
    const Progress& progress,
    const std::optional<TextBeside>& beside)
{
  RawlogWriterOptions writerOptions;
  // Level 1 packs noise badly, and the file is written only once.
  writerOptions.compressionLevel = 6;
  writerOptions.jpegQuality = simulator.scene().options.camera.jpegQuality;
  RawlogWriter writer(rawlog, writerOptions);
  if (beside) writeTextFile(writer.addElsewhere(beside->path), beside->text);

  SimulationSummary summary;
  Trajectory trajectory;
  std::vector<unsigned> framesVisible(simulator.scene().objects.size(), 0);
  const std::size_t batch = std::clamp(std::thread::hardware_concurrency(), 1U, 8U);
  for (std::size_t first = 0; first < simulator.frameCount(); first += batch)
  {
    const std::size_t last = std::min(first + batch, simulator.frameCount());
    const auto frames = makeFrames(simulator, first, last);
    for (std::size_t i = first; i < last; ++i)
    {
      const SimulatedFrame& frame = frames[i - first];
      write(simulator, i, frame, writer);
      if (isFirstOfItsTime(simulator, i))
        trajectory.push_back({simulator.time(i), simulator.truePoses()[i]});
      for (const auto& seen : frame.visible) ++framesVisible[seen.object];
      summary.boxes += frame.objects->objects.size();
    }
    if (progress) progress(static_cast<double>(last) / static_cast<double>(simulator.frameCount()));
  }
  summary.frames = simulator.frameCount();
  summary.truth = truthOf(simulator.scene(), framesVisible);

  const SimulationFiles files(rawlog);
  writeObjectsJson(writer.add(nameOf(files.truth)), summary.truth, "world");
  writeTumTrajectory(writer.add(nameOf(files.trajectory)), trajectory);
  writer.finish();
  return summary;
}

}  // namespace quadmap::simulator
