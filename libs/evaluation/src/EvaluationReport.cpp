#include "quadmap/evaluation/EvaluationReport.h"

#include <mrpt/core/format.h>

#include <filesystem>
#include <stdexcept>

namespace quadmap
{
namespace
{
std::string inFolder(const EvaluationInput& input, const char* file)
{
  return (std::filesystem::path(input.outputFolder) / file).string();
}

std::vector<PosePair> pairsWithTruth(
    const std::string& path, const Trajectory& estimated, const EvaluationInput& input)
{
  const Trajectory truth = readTumTrajectory(*input.trueTrajectoryPath);
  auto pairs = pairByTime(truth, estimated, input.maxTimeDifference);
  if (pairs.empty())
    throw std::runtime_error(mrpt::format(
        "%s: none of its %zu poses is within %g s of one of the %zu poses of %s", path.c_str(),
        estimated.size(), input.maxTimeDifference, truth.size(),
        input.trueTrajectoryPath->c_str()));
  return pairs;
}

/** \param T_truth_estimated Receives the alignment; untouched when comparing in place. */
TrajectoryEvaluation evaluateTrajectory(
    const EvaluationInput& input,
    mrpt::poses::CPose3D& T_truth_estimated,
    std::vector<std::string>& notes)
{
  const std::string path = inFolder(input, "trajectory.tum");
  const Trajectory estimated = readTumTrajectory(path);
  const auto pairs = pairsWithTruth(path, estimated, input);
  if (!input.inPlace)
  {
    const TrajectoryAlignment alignment = alignTrajectories(pairs);
    T_truth_estimated = alignment.T_truth_estimated;
    if (alignment.source == AlignmentSource::Orientations)
      notes.push_back(mrpt::format(
          "The positions do not determine the rotation between the two worlds (their second extent "
          "is %.3f m, less than %.3f m): the orientations of the poses were used as well.",
          alignment.secondSpread, kMinSecondSpread));
  }
  return {estimated.size(), pairs.size(), ateRmse(pairs, T_truth_estimated), std::nullopt};
}

std::optional<double> odometryAte(const EvaluationInput& input)
{
  const std::string path = inFolder(input, "trajectory_odometry.tum");
  if (!std::filesystem::exists(path)) return std::nullopt;
  const Trajectory odometry = readTumTrajectory(path);
  if (odometry.empty()) return std::nullopt;
  const auto pairs = pairsWithTruth(path, odometry, input);
  const auto T =
      input.inPlace ? mrpt::poses::CPose3D() : alignTrajectories(pairs).T_truth_estimated;
  return ateRmse(pairs, T);
}
}  // namespace

EvaluationReport evaluateRun(const EvaluationInput& input)
{
  if (!std::filesystem::is_directory(input.outputFolder))
    throw std::runtime_error(input.outputFolder + ": no such folder");

  EvaluationReport report;
  if (input.inPlace)
    report.notes.push_back("Compared in place: the worlds were not aligned.");
  else if (!input.trueTrajectoryPath)
    report.notes.push_back("Without a true trajectory the objects are compared in place.");

  if (input.trueTrajectoryPath)
  {
    report.trajectory = evaluateTrajectory(input, report.T_truth_estimated, report.notes);
    report.trajectory->ateRmseOdometry = odometryAte(input);
  }
  if (input.trueObjectsPath)
    report.objects = evaluateObjects(
        readObjectsJson(*input.trueObjectsPath), readObjectsJson(inFolder(input, "objects.json")),
        report.T_truth_estimated, input.objects);
  return report;
}

}  // namespace quadmap
