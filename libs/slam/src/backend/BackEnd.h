#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "quadmap/graph/GraphFactors.h"
#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/slam/SlamConfiguration.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** Turns measured keyframes into poses and objects; each method of the program has its own.
 *
 * The keyframe that is added is the next one of `result`, which gets the map and the decisions;
 * the keyframe itself is appended by the caller. Single-threaded and deterministic. */
class BackEnd
{
 public:
  virtual ~BackEnd() = default;

  /** \param step Motion since the keyframe before; nothing for the first one.
   *  \param boxes With their measurements; null when nobody looked.
   *  \return Its pose; those of earlier ones may have changed too. */
  virtual mrpt::poses::CPose3D addKeyframe(
      const mrpt::poses::CPose3D& T_odom_robot,
      const std::optional<mrpt::poses::CPose3DPDFGaussian>& step,
      const CObservationObjects* boxes,
      SlamResult& result) = 0;

  /** Boxes of a keyframe, with their measurements; null when nobody looked. */
  using BoxesOf = std::function<CObservationObjects::Ptr(std::size_t)>;

  /** After the last keyframe: `result`'s poses, map and decisions become the final ones. */
  virtual void finish(const BoxesOf& boxesOf, SlamResult& result) = 0;

  /** After finish(): finds places that the run came back to without noticing, and estimates
   * everything anew with their objects as one. This one does not.
   *  \param shouldStop Remembers a yes; what is closed then stays, and `result` is told. */
  virtual void closeLoops(
      const BoxesOf& boxesOf, const std::function<bool()>& shouldStop, SlamResult& result);

  /** What a map says of the objects of a run, by the run's ids. Both are in the map's frame. */
  using KnownObjects = std::function<std::map<ObjectId, ObjectPrior>(const CQuadricObjectMap&)>;

  /** After finish(), and after the poses were moved into the frame of a map: estimates everything
   * anew with what that map says, asking it again in each round. `result`'s map and decisions,
   * still those of the run alone, and its edges then belong to its poses. This one believes the
   * poses. */
  virtual void correctWith(
      const KnownObjects& knownObjects, const BoxesOf& boxesOf, SlamResult& result);

  /** Inserts the boxes of a keyframe into the map of `result` and notes the decisions.
   *  \param poseError Of the pose, on top of the map's `insertionOptions.poseNoise`. */
  static void insertIntoMap(
      const CObservationObjects& boxes,
      std::size_t keyframe,
      const mrpt::poses::CPose3D& T_map_robot,
      SlamResult& result,
      const PoseNoise& poseError = {0, 0});

  /** Consolidates the map of `result`, which may merge objects: the decisions follow. */
  static void consolidateMap(SlamResult& result);

 protected:
  /** Makes map and decisions anew, at the poses of the keyframes. */
  static void rebuildMap(const BoxesOf& boxesOf, SlamResult& result);
};

/** The one that a run's method and source of poses ask for.
 *  \param labels Must outlive it. */
std::unique_ptr<BackEnd> createBackEnd(
    const SlamConfiguration& configuration, const LabelTable& labels);

}  // namespace quadmap
