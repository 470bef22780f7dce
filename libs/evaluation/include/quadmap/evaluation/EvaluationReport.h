#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/evaluation/ObjectEvaluation.h"
#include "quadmap/evaluation/TrajectoryAlignment.h"

namespace quadmap
{
/** What a run of quadmap-slam is compared with. */
struct EvaluationInput
{
  std::string outputFolder;                       //!< OUTDIR of quadmap-slam
  std::optional<std::string> trueObjectsPath;     //!< Form of objects.json
  std::optional<std::string> trueTrajectoryPath;  //!< TUM form
  bool inPlace = false;             //!< Both worlds are the same: compare without alignment
  double maxTimeDifference = 0.02;  //!< Between a true and an estimated pose [s]
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
 * there is a truth for them, and compares.
 * \exception std::runtime_error On files that are missing, malformed, or have no common times. */
EvaluationReport evaluateRun(const EvaluationInput& input);

/** The form of doc/mathematics.md: metres and degrees, null for what does not exist. */
std::string toJson(const EvaluationReport& report);

/** For people: the figures, a row for each match, then the missed and the spurious objects. */
std::string toTable(const EvaluationReport& report);

}  // namespace quadmap
