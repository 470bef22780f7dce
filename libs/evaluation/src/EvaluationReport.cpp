#include "quadmap/evaluation/EvaluationReport.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "quadmap/base/InputFile.h"

namespace quadmap
{
namespace
{
/** Most time between two poses by default in evo_ape [s]. */
constexpr double kMaxTimeDifferenceOfEvo = 0.01;

std::string inFolder(const EvaluationInput& input, const char* file)
{
  return (std::filesystem::path(input.estimate) / file).string();
}

bool isTrajectoryAlone(const EvaluationInput& input)
{
  return !input.mapObjects && std::filesystem::is_regular_file(input.estimate);
}

/** \param reflection Of the true poses, if any. */
std::vector<PosePair> pairsWithTruth(
    const std::string& path,
    const Trajectory& estimated,
    const EvaluationInput& input,
    const std::optional<TruthReflection>& reflection)
{
  const Trajectory truth = readTumTrajectory(*input.trueTrajectoryPath);
  const double maxTimeDifference = input.maxTimeDifference.value_or(
      isTrajectoryAlone(input) ? kMaxTimeDifferenceOfEvo : kMaxTimeDifference);
  auto pairs = pairByTime(truth, estimated, maxTimeDifference);
  if (pairs.empty())
    throw std::runtime_error(mrpt::format(
        "%s: none of its %zu poses is within %g s of one of the %zu poses of %s", path.c_str(),
        estimated.size(), maxTimeDifference, truth.size(), input.trueTrajectoryPath->c_str()));
  if (reflection)
    for (PosePair& pair : pairs) pair.T_truth_body = (*reflection)(pair.T_truth_body);
  return pairs;
}

double ateOf(const std::vector<PosePair>& pairs, bool inPlace)
{
  return ateRmse(pairs, inPlace ? mrpt::poses::CPose3D() : alignPositions(pairs));
}

/** The reflection of the truth when its world is left-handed, which a note then says. */
std::optional<TruthReflection> findReflection(
    const std::vector<PosePair>& pairs, const EvaluationInput& input, EvaluationReport& report)
{
  if (input.inPlace || isTrajectoryAlone(input)) return std::nullopt;
  const auto reflection = reflectionOfTruth(pairs);
  if (reflection)
    report.notes.push_back(
        "The true world is left-handed, as its poses turn the other way: y is negated in it.");
  return reflection;
}

/** Evaluates the trajectory.
 * \param report Receives the alignment and the reflection, unless the comparison is in place. */
TrajectoryEvaluation evaluateTrajectory(const EvaluationInput& input, EvaluationReport& report)
{
  const std::string path =
      isTrajectoryAlone(input) ? input.estimate : inFolder(input, "trajectory.tum");
  const Trajectory estimated = readTumTrajectory(path);
  auto pairs = pairsWithTruth(path, estimated, input, std::nullopt);
  for (const std::string& file : {path, *input.trueTrajectoryPath})
    if (const auto warning = warningOfCut(file); !warning.empty())
      report.notes.push_back(file + " " + warning + ".");
  report.reflection = findReflection(pairs, input, report);
  if (report.reflection) pairs = pairsWithTruth(path, estimated, input, report.reflection);
  if (!input.inPlace && pairs.size() == 1)
  {
    const std::string text =
        path + ": only one pose has a true one: aligned to it, its error is zero whatever it is";
    if (!input.trueObjectsPath) throw std::runtime_error(text + "; try --in-place");
    report.notes.push_back(text + ".");
  }
  if (!input.inPlace)
  {
    const TrajectoryAlignment alignment = alignTrajectories(pairs);
    report.T_truth_estimated = alignment.T_truth_estimated;
    if (alignment.source == AlignmentSource::Orientations && input.trueObjectsPath)
      report.notes.push_back(mrpt::format(
          "The positions do not determine the rotation between the two worlds (their second extent "
          "is %.3f m, less than %.3f m): for the objects the orientations of the poses were used "
          "as well.",
          alignment.secondSpread, alignment.leastSpread));
  }
  return {estimated.size(), pairs.size(), ateOf(pairs, input.inPlace), std::nullopt};
}

std::optional<double> odometryAte(
    const EvaluationInput& input, const std::optional<TruthReflection>& reflection)
{
  if (isTrajectoryAlone(input)) return std::nullopt;
  const std::string path = inFolder(input, "trajectory_odometry.tum");
  if (!std::filesystem::exists(path)) return std::nullopt;
  const Trajectory odometry = readTumTrajectory(path);
  if (odometry.empty()) return std::nullopt;
  return ateOf(pairsWithTruth(path, odometry, input, reflection), input.inPlace);
}

/** The true objects that are there when the run ends. */
std::vector<ObjectRecord> trueObjects(
    const EvaluationInput& input,
    const std::optional<TruthReflection>& reflection,
    std::vector<std::string>& notes)
{
  auto truth = readObjectsJson(*input.trueObjectsPath);
  if (reflection)
    for (ObjectRecord& record : truth) record.object = (*reflection)(record.object);
  const auto comesOrGoes = [](const ObjectRecord& object) { return object.from || object.to; };
  if (std::none_of(truth.begin(), truth.end(), comesOrGoes)) return truth;
  if (input.mapObjects)
    throw std::runtime_error(
        input.estimate + ": a map by itself does not say which objects of " +
        *input.trueObjectsPath + " are still there; give the folder");
  const std::string path = inFolder(input, "trajectory.tum");
  const Trajectory trajectory = readTumTrajectory(path);
  if (trajectory.empty())
    throw std::runtime_error(
        path + ": no pose; the last one says which objects of " + *input.trueObjectsPath +
        " are still there");
  double end = trajectory.front().time;
  for (const StampedPose& pose : trajectory) end = std::max(end, pose.time);
  const auto before = truth.size();
  truth.erase(
      std::remove_if(
          truth.begin(), truth.end(),
          [&](const ObjectRecord& object)
          { return (object.from && end < *object.from) || (object.to && end >= *object.to); }),
      truth.end());
  if (truth.size() < before)
    notes.push_back(mrpt::format(
        "Objects come and go: the %zu that stand there at the end, %.3f s, are the truth.",
        truth.size(), end));
  return truth;
}
}  // namespace

EvaluationReport evaluateRun(const EvaluationInput& input)
{
  if (isTrajectoryAlone(input) && input.trueObjectsPath)
    throw std::runtime_error(input.estimate + ": a trajectory alone has no objects to compare");
  if (input.mapObjects && input.trueTrajectoryPath)
    throw std::runtime_error(
        input.estimate +
        ": a map by itself has no trajectory to compare or to align; give the "
        "folder");
  if (!std::filesystem::exists(input.estimate))
    throw std::runtime_error(input.estimate + ": no such folder, nor a file with a trajectory");

  EvaluationReport report;
  if (input.inPlace)
    report.notes.push_back("Compared in place: the worlds were not aligned.");
  else if (!input.trueTrajectoryPath)
    report.notes.push_back("Without a true trajectory the objects are compared in place.");

  if (input.trueTrajectoryPath)
  {
    report.trajectory = evaluateTrajectory(input, report);
    report.trajectory->ateRmseOdometry = odometryAte(input, report.reflection);
  }
  const std::string objectsPath =
      input.mapObjects ? input.estimate : inFolder(input, "objects.json");
  if (input.trueObjectsPath) try
    {
      report.objects = evaluateObjects(
          trueObjects(input, report.reflection, report.notes),
          input.mapObjects ? *input.mapObjects : readObjectsJson(objectsPath),
          report.T_truth_estimated, input.objects);
    }
    catch (const TooManyObjects& e)
    {
      throw std::runtime_error(*input.trueObjectsPath + " and " + objectsPath + ": " + e.what());
    }
  return report;
}

}  // namespace quadmap
