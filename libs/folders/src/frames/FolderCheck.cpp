#include "quadmap/folders/FolderCheck.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>
#include <mrpt/poses/Lie/SO.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "quadmap/geometry/RobustStatistics.h"

namespace quadmap
{
namespace
{
constexpr double kGapFactor = 5;  // default gap / median interval
constexpr double kNearShare = 0.01,
                 kFarShare = 0.99;  // percentiles of depth, as some pixels are wrong

/** 0 when there are no values: nothing is known of what is usual. */
double usualOf(const std::vector<double>& values) { return values.empty() ? 0 : median(values); }

/** How often each value of the depth images occurs. The value is the index. */
using DepthCounts = std::vector<std::size_t>;

/** Counts the depths of an image. \return Whether it has any. */
bool countDepths(const mrpt::obs::CObservation3DRangeScan& scan, DepthCounts& counts)
{
  bool any = false;
  for (int v = 0; v < scan.rangeImage.rows(); v += 4)  // every 16th pixel is enough for percentiles
    for (int u = 0; u < scan.rangeImage.cols(); u += 4)
    {
      const std::uint16_t value = scan.rangeImage(v, u);
      if (value == 0) continue;
      ++counts[value];
      any = true;
    }
  return any;
}

/** The least value that is not exceeded by at least this share of all values. */
std::size_t quantile(const DepthCounts& counts, double share)
{
  const auto total = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  std::size_t value = 0, sum = counts[0];
  while (static_cast<double>(sum) < share * static_cast<double>(total)) sum += counts[++value];
  return value;
}

void checkBoxes(const FrameFolder& folder, std::size_t frame, FolderProblems& problems)
try
{
  if (!folder.hasDetections()) return;
  const std::string file = folder.boxesFile(frame);
  const auto boxes = folder.boxes(frame);
  if (!boxes) return problems["missing file"].push_back(file);
  const auto unusable = folder.unusableBoxes(frame, *boxes);
  for (const auto& [box, why] : unusable) problems["box"].push_back(why);
  const std::size_t usable = boxes->objects.size() - unusable.size();
  if (usable > CObservationObjects::kMostObjects)
    problems["box"].push_back(mrpt::format(
        "%s: has %zu boxes, of which the %u with the highest scores can be used", file.c_str(),
        usable, CObservationObjects::kMostObjects));
}
catch (const std::exception& e)
{
  problems["box"].push_back(e.what());
}

void checkImages(
    const FrameFolder& folder, std::size_t index, DepthCounts& depths, FolderProblems& problems)
{
  const auto& frame = folder.frames()[index];
  bool complete = true;
  std::error_code ignored;  // who reads the image tells
  for (const auto& file : {frame.color, frame.depth})
    if (std::filesystem::status(file, ignored).type() == std::filesystem::file_type::not_found)
    {
      problems["missing file"].push_back(file + " (" + frame.listed + ")");
      complete = false;
    }
  if (!complete) return;
  try
  {
    if (!countDepths(*folder.scan(index), depths))
      problems["no depth"].push_back(frame.depth + ": no pixel has a depth");
  }
  catch (const std::exception& e)
  {
    problems["image"].push_back(e.what());
  }
}

void checkDepthScale(
    const FrameFolder& folder,
    const DepthCounts& depths,
    const FolderCheckOptions& options,
    FolderProblems& problems)
{
  const double factor = folder.camera().depthFactor;
  const double nearest = static_cast<double>(quantile(depths, kNearShare)) / factor;  // [m]
  const double farthest = static_cast<double>(quantile(depths, kFarShare)) / factor;  // [m]
  const bool measured = farthest > 0;
  if (!measured || (nearest >= options.minDepth && farthest <= options.maxDepth)) return;
  problems["depth scale"].push_back(mrpt::format(
      "98 %% of the depths are between %.3g and %.3g m: depth_factor %g of %s looks wrong "
      "(plausible: %g..%g m)",
      nearest, farthest, factor, folder.camera().origin.c_str(), options.minDepth,
      options.maxDepth));
}

void checkTimes(
    const FrameFolder& folder, const FolderCheckOptions& options, FolderProblems& problems)
{
  const auto& frames = folder.frames();
  std::vector<double> intervals;  // [s]
  for (std::size_t i = 1; i < frames.size(); ++i)
    if (frames[i].time > frames[i - 1].time)
      intervals.push_back(frames[i].time - frames[i - 1].time);
  const double maxGap = options.maxGap > 0 ? options.maxGap : kGapFactor * usualOf(intervals);
  for (std::size_t i = 1; i < frames.size(); ++i)
  {
    const double step = frames[i].time - frames[i - 1].time;
    if (step <= 0)
      problems["time going backwards"].push_back(
          mrpt::format("%s: %.6f s before the frame before", frames[i].listed.c_str(), -step));
    else if (step > maxGap)
      problems["gap in time"].push_back(mrpt::format(
          "%s: %.3f s after the frame before (limit %.3f s)", frames[i].listed.c_str(), step,
          maxGap));
  }
}

struct Motion
{
  std::size_t frame;
  double speed, turnRate;  // from the frame before [m/s], [rad/s]
};

std::vector<Motion> motionsOf(const FrameFolder& folder, FolderProblems& problems)
{
  std::vector<Motion> motions;
  std::optional<std::size_t> previous;
  std::optional<mrpt::poses::CPose3D> T_world_previous;
  for (std::size_t i = 0; i < folder.frames().size(); ++i)
  {
    const auto T_world_robot = folder.T_world_robot(i);
    if (const std::string& problem = folder.frames()[i].poseProblem; !problem.empty())
    {
      problems["pose"].push_back(problem);
      continue;
    }
    if (!T_world_robot)
    {
      problems["no pose"].push_back(mrpt::format(
          "%s: %s does not cover %.6f s", folder.frames()[i].listed.c_str(), folder.poses().c_str(),
          folder.frames()[i].time));
      continue;
    }
    const double dt = previous ? folder.frames()[i].time - folder.frames()[*previous].time : 0;
    if (dt > 0)
    {
      const auto T_previous_robot = *T_world_robot - *T_world_previous;
      const auto turn = mrpt::poses::Lie::SO<3>::log(T_previous_robot.getRotationMatrix());
      motions.push_back({i, T_previous_robot.translation().norm() / dt, turn.norm() / dt});
    }
    previous = i;
    T_world_previous = T_world_robot;
  }
  return motions;
}

void checkMotion(
    const FrameFolder& folder, const FolderCheckOptions& options, FolderProblems& problems)
{
  if (folder.poses().empty() || folder.posesAreRefused()) return;
  const auto motions = motionsOf(folder, problems);
  std::vector<double> speeds, turnRates;
  for (const auto& m : motions)
  {
    speeds.push_back(m.speed);
    turnRates.push_back(m.turnRate);
  }
  const double speedLimit = std::max(options.maxSpeed, options.jumpFactor * usualOf(speeds));
  const double turnLimit =
      std::max(mrpt::DEG2RAD(options.maxTurnRate_deg), options.jumpFactor * usualOf(turnRates));
  for (const auto& m : motions)
    if (m.speed > speedLimit || m.turnRate > turnLimit)
      problems["pose jumps"].push_back(mrpt::format(
          "%s: %.2f m/s, %.0f deg/s since the frame before (limits %.2f, %.0f)",
          folder.frames()[m.frame].listed.c_str(), m.speed, mrpt::RAD2DEG(m.turnRate), speedLimit,
          mrpt::RAD2DEG(turnLimit)));
}

void check(const FolderCheckOptions& o)
{
  const auto require = [](bool good, const char* what, double value)
  {
    if (!good) throw std::invalid_argument(mrpt::format("%s, got %g", what, value));
  };
  require(o.maxGap >= 0, "maxGap: must be >= 0 s", o.maxGap);
  require(o.minDepth > 0, "minDepth: must be > 0 m", o.minDepth);
  require(o.maxDepth > o.minDepth, "maxDepth: must be > minDepth [m]", o.maxDepth);
  require(o.jumpFactor > 1, "jumpFactor: must be > 1", o.jumpFactor);
  require(o.maxSpeed > 0, "maxSpeed: must be > 0 m/s", o.maxSpeed);
  require(o.maxTurnRate_deg > 0, "maxTurnRate_deg: must be > 0 deg/s", o.maxTurnRate_deg);
}
}  // namespace

FolderProblems checkFolder(
    const FrameFolder& folder,
    const FolderCheckOptions& options,
    const std::function<void(double)>& progress)
{
  check(options);
  FolderProblems problems;
  if (!folder.listProblems().empty()) problems["list"] = folder.listProblems();
  if (!folder.posesProblems().empty()) problems["pose"] = folder.posesProblems();
  DepthCounts depths(std::numeric_limits<std::uint16_t>::max() + std::size_t{1});
  const std::size_t frames = folder.frames().size();
  for (std::size_t i = 0; i < frames; ++i)
  {
    progress(static_cast<double>(i) / static_cast<double>(frames));
    checkImages(folder, i, depths, problems);
    checkBoxes(folder, i, problems);
  }
  checkDepthScale(folder, depths, options, problems);
  checkTimes(folder, options, problems);
  checkMotion(folder, options, problems);
  progress(1.0);
  return problems;
}

}  // namespace quadmap
