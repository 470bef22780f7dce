#include "quadmap/obs/Trajectory.h"

#include <mrpt/core/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "quadmap/base/ConfigCheck.h"
#include "quadmap/base/InputFile.h"
#include "quadmap/base/OutputFile.h"
#include "quadmap/base/OutputSet.h"
#include "quadmap/base/Words.h"
#include "quadmap/geometry/PosePosition.h"
#include "quadmap/obs/Plausible.h"
#include "quadmap/obs/TimeOrder.h"
#include "quadmap/obs/UnusableLines.h"

namespace quadmap
{
namespace
{
constexpr std::size_t kColumns = 8;
constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 25;
/** A pose at 100 Hz for more than an hour. A short line takes 30 times its length in memory. */
constexpr int kMostPoses = 400'000;

mrpt::poses::CPose3D poseFrom(const Eigen::Quaterniond& q, const Eigen::Vector3d& t)
{
  mrpt::math::CMatrixDouble44 T;
  T.setIdentity();
  T.asEigen().topLeftCorner<3, 3>() = q.toRotationMatrix();
  T.asEigen().topRightCorner<3, 1>() = t;
  return mrpt::poses::CPose3D(T);
}

Eigen::Quaterniond quaternionOf(const mrpt::poses::CPose3D& T)
{
  return Eigen::Quaterniond(Eigen::Matrix3d(T.getRotationMatrix().asEigen()));
}

/** Reads a finite number. \param place "file:line" for messages. */
double parseNumber(const std::string& word, const std::string& place)
{
  double value = 0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value))
    throw std::runtime_error(place + ": " + quotedWord(word) + " is not a finite number");
  return value;
}

StampedPose parsePose(const std::vector<std::string>& words, const std::string& place)
{
  if (words.size() != kColumns)
    throw std::runtime_error(
        mrpt::format("%s: expected %zu columns, got %zu", place.c_str(), kColumns, words.size()));
  std::array<double, kColumns> v{};
  for (std::size_t i = 0; i < kColumns; ++i) v[i] = parseNumber(words[i], place);
  const Eigen::Quaterniond q(v[7], v[4], v[5], v[6]);  // Eigen's constructor starts with w
  if (!(std::abs(v[0]) <= kLatestTime))
    throw std::runtime_error(place + ": " + quotedWord(words[0]) + " is no time in seconds");
  if (!(Eigen::Vector3d(v[1], v[2], v[3]).norm() <= kFarthestPosition))
    throw std::runtime_error(place + ": the position is absurdly far away");
  if (const auto why = whyNoUnitQuaternion(q))
    throw std::runtime_error(place + ": quaternion " + *why);
  return {v[0], poseFrom(q.normalized(), {v[1], v[2], v[3]})};
}

std::string placeOf(const std::string& path, int line) { return path + ":" + std::to_string(line); }

/** Calls \c f(words, line) for each line, counted from 1, that is neither empty nor a comment. */
template <typename F>
void forEachLine(const std::string& path, const F& f)
{
  requireOneRun(path);
  auto file = openModestText(path, kMostBytes);
  std::string line;
  for (int number = 1, poses = 0; std::getline(file, line); ++number)
  {
    const auto words = wordsOf(std::string_view(line).substr(0, line.find('#')));
    if (words.empty()) continue;
    if (++poses > kMostPoses)
      throw std::runtime_error(mrpt::format(
          "%s: has more than the %d poses that a trajectory may have", path.c_str(), kMostPoses));
    f(words, number);
  }
  if (file.bad()) throw std::runtime_error(path + ": read error");
}

/** Poses and where they are from. No two that follow each other have the same time. */
struct PoseLines
{
  Trajectory poses;
  std::vector<double> times;  // theirs [s]
  std::vector<int> lines;
};

/** The poses that can be read, in the order of the file. */
PoseLines readPoseLines(const std::string& path, std::vector<std::string>& unusable)
{
  PoseLines read;
  const auto add = [&](const StampedPose& pose, int line)
  {
    if (read.poses.empty() || pose.time != read.times.back())
    {
      read.poses.push_back(pose);
      read.times.push_back(pose.time);
      read.lines.push_back(line);
    }
    else if (pose.pose != read.poses.back().pose)
      throw std::runtime_error(mrpt::format(
          "%s: line %d has another pose at %.6f s", placeOf(path, line).c_str(), read.lines.back(),
          pose.time));
  };
  const auto addOrNote = [&](const std::vector<std::string>& words, int line)
  {
    try
    {
      add(parsePose(words, placeOf(path, line)), line);
    }
    catch (const std::runtime_error& e)
    {
      noteUnusable(unusable, path, e.what());
    }
  };
  forEachLine(path, addOrNote);
  return read;
}
}  // namespace

Trajectory readTumTrajectory(const std::string& path)
{
  Trajectory trajectory;
  const auto add = [&](const std::vector<std::string>& words, int line)
  { trajectory.push_back(parsePose(words, placeOf(path, line))); };
  forEachLine(path, add);
  return trajectory;
}

Trajectory readTrajectoryInOrder(const std::string& path, std::vector<std::string>& unusable)
{
  const PoseLines read = readPoseLines(path, unusable);
  Trajectory inOrder;
  std::optional<double> last;  // [s]
  for (std::size_t i = 0; i < read.poses.size(); ++i)
    if (const auto why = whyOutOfOrder(read.times, i, last, "pose"))
      noteUnusable(unusable, path, placeOf(path, read.lines[i]) + ": " + *why);
    else
    {
      inOrder.push_back(read.poses[i]);
      last = read.times[i];
    }
  return inOrder;
}

void writeTumTrajectory(const std::string& path, const Trajectory& trajectory)
{
  std::string text = "# time tx ty tz qx qy qz qw\n";
  for (const auto& [time, T] : trajectory)
  {
    const Eigen::Quaterniond q = quaternionOf(T);
    text += mrpt::format(
        "%.6f %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", time, T.x(), T.y(), T.z(), q.x(), q.y(), q.z(),
        q.w());
  }
  writeTextFile(path, text);
}

std::optional<mrpt::poses::CPose3D> poseAt(const Trajectory& trajectory, double time, double maxGap)
{
  const auto after = std::lower_bound(
      trajectory.begin(), trajectory.end(), time,
      [](const StampedPose& sample, double t) { return sample.time < t; });
  if (after == trajectory.end()) return std::nullopt;
  if (after->time == time) return after->pose;
  if (after == trajectory.begin()) return std::nullopt;

  const auto before = after - 1;
  const double gap = after->time - before->time;
  if (gap > maxGap) return std::nullopt;
  const double share = (time - before->time) / gap;
  const Eigen::Vector3d t =
      (1 - share) * positionOf(before->pose) + share * positionOf(after->pose);
  return poseFrom(quaternionOf(before->pose).slerp(share, quaternionOf(after->pose)), t);
}

}  // namespace quadmap
