#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/evaluation/ObjectEvaluation.h"
#include "quadmap/evaluation/TrajectoryAlignment.h"

namespace quadmap
{
/** Between a pose of a run and a true one [s]: half the time between images of 30 Hz. */
constexpr double kMaxTimeDifference = 0.02;

/** What a run of quadmap-slam is compared with. */
struct EvaluationInput
{
  std::string estimate;  //!< OUTDIR of quadmap-slam, or a trajectory alone (TUM form)
  std::optional<std::string> trueObjectsPath;     //!< Form of objects.json
  std::optional<std::string> trueTrajectoryPath;  //!< TUM form
  bool inPlace = false;  //!< Both worlds are the same: compare without alignment
  /** Between a true and an estimated pose [s]; nothing: kMaxTimeDifference, and that of `evo_ape`,
   *  0.01 s, for a trajectory alone. */
  std::optional<double> maxTimeDifference;
  ObjectEvaluationOptions objects;
};

struct TrajectoryEvaluation
{
  std::size_t poses = 0;                  //!< In the estimated trajectory
  std::size_t pairs = 0;                  //!< Of them with a true pose: the figures are over these
  double ateRmse = 0;                     //!< [m]
  std::optional<double> ateRmseOdometry;  //!< [m], aligned on its own; nothing without the file
};

struct EvaluationReport
{
  std::optional<TrajectoryEvaluation> trajectory;  //!< Nothing without a true trajectory
  std::optional<ObjectEvaluation> objects;         //!< Nothing without true objects
  mrpt::poses::CPose3D T_truth_estimated;          //!< Identity when compared in place
  std::vector<std::string> notes;  //!< What a reader of the figures must know, a sentence each
};

/** Reads OUTDIR's trajectory.tum, trajectory_odometry.tum (if there) and objects.json, as far as
 * there is a truth for them, and compares. Objects that come and go (`from`, `to`) are true as of
 * the last pose of trajectory.tum. The ATE is that of `evo_ape --align`.
 * \exception std::runtime_error On files that are missing, malformed, or have no common times. */
EvaluationReport evaluateRun(const EvaluationInput& input);

/** The form of doc/mathematics.md: metres and degrees, null for what does not exist. */
std::string toJson(const EvaluationReport& report);

/** For people: the figures, a row for each match, then the missed and the spurious objects. */
std::string toTable(const EvaluationReport& report);

}  // namespace quadmap
