#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "BackEnd.h"
#include "MergedObjects.h"
#include "OdometryChain.h"
#include "quadmap/constellation/ConstellationOptions.h"
#include "quadmap/constellation/Doubles.h"
#include "quadmap/graph/FactorGraph.h"

namespace quadmap
{
/** Estimates poses and objects together: objects correct a drifting robot.
 *
 * While running, the latest keyframes are estimated with the objects seen from them; every
 * observation goes into the object map at the corrected pose, with the pose's uncertainty. At the
 * end all poses are estimated, in turn with the associations. */
class JointBackEnd : public BackEnd
{
 public:
  /** \param labels Must outlive this object. */
  JointBackEnd(
      const JointOptions& options,
      const CQuadricObjectMap::TInsertionOptions& mapOptions,
      const LabelTable& labels,
      const ConstellationOptions& places = {});

  mrpt::poses::CPose3D addKeyframe(
      const mrpt::poses::CPose3D& T_odom_robot,
      const std::optional<mrpt::poses::CPose3DPDFGaussian>& step,
      const CObservationObjects* boxes,
      SlamResult& result) override;

  /** Optimises everything in turn with the associations, and rebuilds the map at the corrected
   * poses. `result` is told how it went. */
  void finish(const BoxesOf& boxesOf, SlamResult& result) override;

  void closeLoops(
      const BoxesOf& boxesOf, const std::function<bool()>& shouldStop, SlamResult& result) override;

  /** As finish(), but it is the known objects that say where the map lies. */
  void correctWith(
      const KnownObjects& knownObjects, const BoxesOf& boxesOf, SlamResult& result) override;

 private:
  using Decisions = std::vector<CQuadricObjectMap::Decision>;

  std::optional<BoxMeasurement> viewFor(
      const CObservationObjects& boxes,
      std::size_t box,
      const mrpt::poses::CPose3D& T_map_robot,
      const MapObject& object) const;
  void addViews(
      const CObservationObjects& boxes,
      const Decisions& decisions,
      std::size_t pose,
      const CQuadricObjectMap& map);
  using Priors = std::map<ObjectId, ObjectPrior>;

  enum class FirstPose
  {
    Fixed,
    FreeToTilt  // by upSigma, on visual odometry
  };
  enum class Returns
  {
    FindTheSameObjects,
    FindOtherObjects  // whatever was not seen for as long as the window
  };
  struct Visit;
  using Visits = std::map<ObjectId, std::vector<Visit>>;
  /** Which views belong to which object, and to which visit. An object that returns find again has
   * one visit. */
  Visits visitsOf(const BoxesOf& boxesOf, const SlamResult& result, Returns returns) const;
  /** Puts each visit into a graph as an object. The first one of an object has its id.
   * \param firstPose That of the first keyframe. */
  void addVisits(
      Visits all,
      const CQuadricObjectMap& map,
      const Priors& priors,
      std::size_t firstPose,
      FactorGraph& graph) const;
  /** All poses and objects. With priors pose 0 is the map, and when the first pose is not fixed
   * where that was so far; either makes pose k + 1 that of keyframe k.
   * \exception std::invalid_argument If objects that are others at each visit have priors. */
  FactorGraph globalGraph(
      const BoxesOf& boxesOf,
      const SlamResult& result,
      const Priors& priors,
      FirstPose firstPose,
      Returns returns = Returns::FindTheSameObjects) const;
  /** Those that are explained by what may have moved the poses. */
  std::optional<Doubles> doublesOf(
      const StepNoise& noise,
      const BoxesOf& boxesOf,
      const std::function<bool()>& shouldStop,
      const SlamResult& result) const;
  /** Moves the keyframes to where a graph has them. \return The longest move [m]. */
  static double takePoses(const FactorGraph& graph, const Priors& priors, SlamResult& result);
  /** Rounds of association and estimation. */
  void estimate(const KnownObjects& knownObjects, const BoxesOf& boxesOf, SlamResult& result) const;
  /** The run with these doubles as one. Nothing when they are not: other things are torn then, or
   * nothing can be estimated. */
  std::optional<SlamResult> closedLoop(
      const Doubles& doubles,
      const StepNoise& noise,
      const BoxesOf& boxesOf,
      const SlamResult& result) const;

  JointOptions options_;
  PoseNoise viewNoise_;  //!< Of the map's options: what a view errs by beyond its faces
  EstimatorOptions estimator_;
  ExistenceOptions existence_;
  AgreementOptions agreement_;
  const LabelTable& labels_;
  ConstellationOptions places_;
  FactorGraph graph_;
  StepFit stepFit_;  //!< Of the steps that have left the window
  OdometryMotion odometry_;
  CamerasOf cameras_;
};

}  // namespace quadmap
