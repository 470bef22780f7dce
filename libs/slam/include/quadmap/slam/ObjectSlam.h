#pragma once

#include <mrpt/system/COutputLogger.h>

#include <cstddef>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "quadmap/obs/LabelTable.h"
#include "quadmap/sensors/RgbdFrame.h"
#include "quadmap/slam/KeyframeSelector.h"
#include "quadmap/slam/KeyframeSpool.h"
#include "quadmap/slam/ModuleTimes.h"
#include "quadmap/slam/OdometryInput.h"
#include "quadmap/slam/SingleMoment.h"
#include "quadmap/slam/SlamConfiguration.h"
#include "quadmap/slam/SlamResult.h"
#include "quadmap/slam/pipeline/BackEndStage.h"
#include "quadmap/slam/pipeline/KeyframeTask.h"
#include "quadmap/slam/pipeline/PerceptionStage.h"
#include "quadmap/slam/pipeline/StagePipeline.h"

namespace quadmap
{
/** Something is wrong with this one frame; the next ones may be fine. */
struct BadFrame : std::runtime_error
{
  BadFrame(const RgbdFrame& frame, const std::string& what) :
      runtime_error(what), record(frame.record), sensor(frame.scan->sensorLabel)
  {
  }
  std::size_t record;  //!< Of the scan in its rawlog
  std::string sensor;
};

/** RGB-D frames with boxes in, trajectory and object map out: keyframes are measured, their
 * measurements go into the map, and correct the odometry's poses on the way. Ground truth poses are
 * taken as given.
 *
 * Works on several keyframes at the same time; the result is the same with any number of threads.
 * Messages come from the caller's thread. */
class ObjectSlam : public mrpt::system::COutputLogger
{
 public:
  /** \param spool Takes the images; must outlive this object.
   *  \param up_robot See OdometryInput.
   *  \param keepGoing Leave out bad frames: they are then in badFrames(). */
  ObjectSlam(
      const SlamConfiguration& configuration,
      const LabelTable& labels,
      KeyframeSpool& spool,
      const std::optional<Eigen::Vector3d>& up_robot = {},
      bool keepGoing = false);

  /** \exception BadFrame This frame or one before is unusable. There is no going on.
   *  \exception std::runtime_error Likewise; the spool's disk is full, for one. */
  void addFrame(const RgbdFrame& frame);

  /** Waits for the frames that are under way. \exception As in addFrame(). */
  void settle();

  /** To be called when the input came to its end, before finish().
   *  \exception std::runtime_error If its images do not fit the poses they were given. */
  void requireAllPosesUsed() const { odometry_.requireAllUsed(); }

  /** After the last frame: settles the map.
   *  \exception As in addFrame().
   *  \exception std::runtime_error If there were frames, but none had a pose. */
  void finish();

  /** After finish(): goes on with the map of an earlier run.
   * \exception NotLocalised If the run cannot be found in it. */
  void continueFrom(const CQuadricObjectMap& map);

  /** Complete after finish(). Until then only what concerns frames and warnings may be read. */
  const SlamResult& result() const { return result_; }
  const std::vector<BadFrame>& badFrames() const { return badFrames_; }
  ModuleTimes& times() { return times_; }

  /** Logs a warning and keeps it for the report. */
  void warn(const std::string& text);

 private:
  std::optional<mrpt::poses::CPose3D> poseOf(const RgbdFrame& frame);
  void tellOdometry(const RgbdFrame& frame);
  void addPosedFrame(const RgbdFrame& frame, const mrpt::poses::CPose3D& T_odom_robot);
  void placeFramesWithoutPose();
  void warnOfMissingDepth();
  static void leaveOutAnonymous(CObservationObjects& boxes);
  void requireInstanceIds() const;
  void warnOfUnknownLabels(const CObservationObjects& boxes);

  // The stages; each is called from one thread at a time
  KeyframeTask& task(std::size_t item) { return tasks_[item % tasks_.size()]; }
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
  std::set<std::string> unknownLabels_;
  bool anyInstanceId_ = false;  //!< Of the boxes so far
  PerceptionStage perception_;
  BackEndStage backEnd_;
  SlamResult result_;
  std::vector<BadFrame> badFrames_;
  ModuleTimes times_;
  std::vector<KeyframeTask> tasks_;  //!< Under way, round and round
  std::size_t added_ = 0, taken_ = 0;
  StagePipeline pipeline_;  //!< The last member: its threads use the others
};

}  // namespace quadmap
