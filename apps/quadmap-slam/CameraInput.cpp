#include "CameraInput.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <vector>

#include "../common/ProgressBar.h"

namespace quadmap
{
namespace
{
const std::string kPrefix = "openni2:";

/** A camera brings no boxes. */
void requireBoxes(const RawlogRunRequest& run)
{
  const SlamOptions& slam = run.configuration.slam;
  if (slam.method == SlamMethod::Odometry || slam.findsBoxes()) return;
  throw cli::UsageError(
      run.rawlog +
      ": a camera brings no boxes of objects: name a detector that finds them (--detector NAME, "
      "see quadmap-detect --list), or take --method odometry for the trajectory alone");
}

/** "3 chair, 1 tv", the most frequent first. */
std::string listOf(const std::map<std::string, std::size_t>& objects)
{
  std::vector<std::pair<std::size_t, std::string>> sorted;
  for (const auto& [label, number] : objects) sorted.emplace_back(number, label);
  std::stable_sort(
      sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text;
  for (const auto& [number, label] : sorted)
    text += (text.empty() ? "" : ", ") + std::to_string(number) + " " + label;
  return text.empty() ? "no object yet" : text;
}
}  // namespace

CameraInput::CameraInput(
    RawlogRunRequest& run,
    cli::CameraArguments& arguments,
    TCLAP::ValueArg<std::string>& calibration)
{
  const bool isCamera = run.rawlog.compare(0, kPrefix.size(), kPrefix) == 0;
  if (!isCamera && calibration.isSet()) throw cli::UsageError("--camera: for openni2 only");
  if (isCamera)
    open(run, arguments.options(calibration));
  else
    arguments.requireNone();
  if (run.isLive)
  {
    run.onMessage = [this, tell = run.onMessage](auto level, const std::string& text)
    {
      if (level >= mrpt::system::LVL_WARN) line_.end();
      tell(level, text);
    };
    run.onProgress = [this](const RunProgress& progress)
    { line_.show([&] { return stateOf(progress); }); };
  }
  else
    run.onProgress = [bar = cli::ProgressBar()](const RunProgress& progress) mutable
    { bar(progress.share); };
}

void CameraInput::open(RawlogRunRequest& run, const CameraOptions& options)
{
  if (!run.objectsFile.empty() || !run.sensorLabel.empty())
    throw cli::UsageError("--objects, --sensor: not for a camera");
  requireBoxes(run);
  const std::string what = run.rawlog.substr(kPrefix.size());
  run.isLive = what == kLiveCamera;
  CameraOptions camera = options;
  if (run.isLive)
  {
    camera.isEnded = run.shouldStop;
    run.shouldStop = [] { return false; };
  }
  camera_ = openOpenNi2(what, camera);
  camera_->logging_enable_console_output = false;
  for (const auto& note : camera_->notes())
    run.onMessage(mrpt::system::LVL_WARN, run.rawlog + ": " + note);
  run.source = camera_;
}

std::string CameraInput::stateOf(const RunProgress& progress) const
{
  const auto counts = camera_->counts();
  return mrpt::format(
             "%.1f s, %zu frames (%zu skipped), %zu keyframes: ", counts.seconds, counts.frames,
             counts.skipped, progress.keyframes) +
         listOf(progress.objects);
}

}  // namespace quadmap
