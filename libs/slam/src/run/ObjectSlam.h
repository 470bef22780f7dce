#pragma once

#include <mrpt/system/COutputLogger.h>

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "keyframes/ContradictedSteps.h"
#include "keyframes/KeyframeSpool.h"
#include "pipeline/BackEndStage.h"
#include "pipeline/DetectionStage.h"
#include "pipeline/KeyframeTask.h"
#include "pipeline/PerceptionStage.h"
#include "pipeline/StagePipeline.h"
#include "quadmap/base/ModuleTimes.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/odometry/OdometryInput.h"
#include "quadmap/odometry/OdometrySurvey.h"
#include "quadmap/odometry/SingleMoment.h"
#include "quadmap/sensors/KeyframeSelector.h"
#include "quadmap/sensors/RgbdFrame.h"
#include "quadmap/slam/SlamConfiguration.h"
#include "quadmap/slam/SlamResult.h"
#include "relocalization/ContinueMap.h"

namespace quadmap
{
/** One frame is wrong. The next ones may be right. */
struct BadFrame : std::runtime_error
{
  BadFrame(const RgbdFrame& frame, const std::string& what) :
      runtime_error(what), record(frame.record), sensor(frame.scan->sensorLabel)
  {
  }
  std::size_t record;  //!< Index of the scan in its rawlog
  std::string sensor;
};

/** Makes trajectory and object map from RGB-D frames with boxes. Perception measures the keyframes.
 * Their measurements correct the poses of the odometry and go into the map. True poses are taken as
 * given.
 *
 * The class works on several keyframes at the same time. The result is the same with any number of
 * threads. Messages come from the caller's thread. */
class ObjectSlam : public mrpt::system::COutputLogger
{
 public:
  /** \param spool Receives the images. It must outlive this object.
   *  \param survey What the start of the recording tells about up.
   *  \param keepGoing Leave out bad frames, which are then in badFrames(). */
  ObjectSlam(
      const SlamConfiguration& configuration,
      const LabelTable& labels,
      KeyframeSpool& spool,
      const OdometrySurvey& survey = {},
      bool keepGoing = false);

  /** \param name Of the recording or camera that the frames are from; it begins the warnings about
   * them. */
  void setInputName(const std::string& name) { inputName_ = name; }

  /** Takes the next frame.
   *  \exception BadFrame If this frame or one before cannot be used. The run cannot go on then.
   *  \exception std::runtime_error For other errors, such as a full disk. It cannot go on either.
   */
  void addFrame(const RgbdFrame& frame);

  /** Waits for the frames that are under way. \exception As in addFrame(). */
  void settle();

  /** Call it at the end of the input, before finish().
   *  \exception std::runtime_error If the images do not fit the given poses. */
  void requireAllPosesUsed() const { odometry_.requireAllUsed(); }

  /** Says so when a given pose graph does not fit the images; empty otherwise. */
  std::string warningOfGraph() const { return odometry_.warningOfGraph(); }

  /** Says so when some images have poses, but most have none; empty otherwise. */
  std::string lackOfPoses() const
  {
    const SlamCounts counts = result_.counts();
    const bool hasSome = counts.framesWithoutPose < counts.frames;
    return hasSome && odometry_.lacksMostPoses() ? odometry_.missingPoses() : std::string();
  }

  /** Call it after the last frame. It makes the final estimate.
   *  \param earlier Map of an earlier run that goes on in this one; null: there is none.
   *  \param shouldStop Remembers a yes. Loops are not closed then, and the result says so.
   *  \exception As in addFrame().
   *  \exception std::runtime_error If there were frames, but none had a pose.
   *  \exception NotLocalised If the run cannot be found in the map. */
  void finish(
      const CQuadricObjectMap* earlier = nullptr,
      const std::function<bool()>& shouldStop = [] { return false; });

  /** For a camera, which does not wait: a frame is no keyframe while the threads that work on the
   * keyframes before are busy, and a later one takes its place. */
  void keepUp() { keepsUp_ = configuration_.slam.workingThreads() > 1; }

  /** Number of confirmed objects of each label, a few keyframes ago. */
  const std::map<std::string, std::size_t>& objectsByLabel() const { return objectsByLabel_; }

  /** The result, complete after finish(). Before that only frames and warnings may be read. */
  const SlamResult& result() const { return result_; }
  const std::vector<BadFrame>& badFrames() const { return badFrames_; }
  ModuleTimes& times() { return times_; }

  /** Logs a warning and keeps it for the report. It names what it is about. */
  void warn(const std::string& text);

 private:
  std::optional<mrpt::poses::CPose3D> poseOf(const RgbdFrame& frame);
  void tellOdometry(const RgbdFrame& frame);
  void addPosedFrame(const RgbdFrame& frame, const mrpt::poses::CPose3D& T_odom_robot);
  void placeFramesWithoutPose();
  void continueFrom(const CQuadricObjectMap& map);
  void warnOfInput(const std::string& text);
  void warnOfMissingDepth();
  void warnOfDroppedFloors();
  void warnOfNoisyOdometry();
  void warnOfOpenLoop();
  void warnOfThingsNotFoundAgain();
  void warnOfDoubtfulPoses();
  static void leaveOutAnonymous(CObservationObjects& boxes);
  void requireInstanceIds() const;
  void lookThrough(const CObservationObjects& boxes);
  void warnOfUnknownLabels();

  // The stages. Each is called from one thread at a time.
  std::vector<StagePipeline::Stage> stages();
  KeyframeTask& task(std::size_t item) { return tasks_[item % tasks_.size()]; }
  void detect(std::size_t item);
  void measure(std::size_t item);
  void addToMap(std::size_t item);
  void spool(std::size_t item);

  void takeFinished();
  void account(const KeyframeTask& task);

  SlamConfiguration configuration_;
  LabelTable labels_;
  KeyframeSpool& spool_;
  bool keepGoing_;
  KeyframeSelector selector_;
  OdometryInput odometry_;
  SingleMoment moment_;
  ContradictedSteps contradictions_;
  std::set<std::string> unknownLabels_;
  std::string inputName_;
  bool anyInstanceId_ = false;  //!< Some box so far has one
  DetectionStage detection_;
  PerceptionStage perception_;
  BackEndStage backEnd_;
  SlamResult result_;
  std::vector<BadFrame> badFrames_;
  std::map<std::string, std::size_t> objectsByLabel_;
  bool keepsUp_ = false;
  ModuleTimes times_;
  std::vector<KeyframeTask> tasks_;  //!< Those under way, in a ring
  std::size_t added_ = 0, taken_ = 0;
  StagePipeline pipeline_;  //!< The last member, as its threads use the others
};

}  // namespace quadmap
