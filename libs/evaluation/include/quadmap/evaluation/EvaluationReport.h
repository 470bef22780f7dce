#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/evaluation/ObjectEvaluation.h"
#include "quadmap/evaluation/SelfCheck.h"
#include "quadmap/evaluation/TrajectoryAlignment.h"
#include "quadmap/evaluation/TruthReflection.h"

namespace quadmap
{
/** Most time between a pose of a run and a true one: more than half the time between images of 30
 * Hz [s]. */
constexpr double kMaxTimeDifference = 0.02;

/** A run of quadmap-slam, and the truth it is compared with. */
struct EvaluationInput
{
  std::string estimate;  //!< OUTDIR of quadmap-slam, a trajectory alone (TUM form), or a map
  /** The objects of `estimate` when that is a map by itself, which has no trajectory; empty: those
   *  of objects.json in the folder. */
  std::optional<std::vector<ObjectRecord>> mapObjects;
  std::optional<std::string> trueObjectsPath;     //!< In the form of objects.json
  std::optional<std::string> trueTrajectoryPath;  //!< In TUM form
  bool inPlace = false;  //!< Compare without alignment, as both worlds are the same
  /** Most time between a true and an estimated pose [s]. When it is empty, it is
   * kMaxTimeDifference, or 0.01 s as in `evo_ape` for a trajectory alone. */
  std::optional<double> maxTimeDifference;
  ObjectEvaluationOptions objects;
};

struct TrajectoryEvaluation
{
  std::size_t poses = 0;  //!< Number of poses of the estimated trajectory
  std::size_t pairs = 0;  //!< Number of these with a true pose; the figures are over them
  double ateRmse = 0;     //!< [m]
  std::optional<double> ateRmseOdometry;  //!< Aligned by itself [m]; empty without the file
};

struct EvaluationReport
{
  std::optional<TrajectoryEvaluation> trajectory;  //!< Empty without a true trajectory
  std::optional<ObjectEvaluation> objects;         //!< Empty without true objects
  std::optional<SelfCheck> self;                   //!< Empty when it was not asked for
  /** Set when the true world is left-handed; the figures are over its mirror image. */
  std::optional<TruthReflection> reflection;
  /** Into the true world, or its mirror image; identity when compared in place. */
  mrpt::poses::CPose3D T_truth_estimated;
  std::vector<std::string> notes;  //!< What a reader of the figures must know, one sentence each
};

/** Compares a run with the truth: doc/mathematics.md, section 20. It reads trajectory.tum,
 * trajectory_odometry.tum (if it exists) and objects.json of OUTDIR, as far as there is a truth for
 * them. Objects that come and go (`from`, `to`) are judged as of the last pose of trajectory.tum.
 * The ATE is that of `evo_ape --align`. A truth whose world is left-handed is reflected, unless it
 * is compared in place or with a trajectory alone.
 * \exception std::runtime_error For files that are missing, malformed or without common times. */
EvaluationReport evaluateRun(const EvaluationInput& input);

/** evaluation.json (doc/formats.md), in metres and degrees, with null for what does not exist. */
std::string toJson(const EvaluationReport& report);

/** A text for people: the figures, a row for each match, and the missed and the spurious objects.
 */
std::string toTable(const EvaluationReport& report);

}  // namespace quadmap
