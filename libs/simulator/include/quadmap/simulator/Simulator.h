#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/obs/ObjectList.h"
#include "quadmap/simulator/RayCaster.h"
#include "quadmap/simulator/SimulatedDetector.h"

namespace quadmap::simulator
{
/** The image of one camera at one time, with the detector's boxes. */
struct SimulatedFrame
{
  mrpt::obs::CObservation3DRangeScan::Ptr scan;  //!< Its sensorLabel is the camera's name
  /** Boxes with the same sensorLabel and time stamp. When the detector labels pixels, these labels
   * are in the scan, and the boxes are only here, for comparison, and not in the files. */
  CObservationObjects::Ptr objects;
  /** For each box of `objects` which of Scene::objects it shows; empty for a false alarm. */
  std::vector<std::optional<std::size_t>> truthOfBox;
  std::vector<VisibleObject> visible;  //!< Objects before the detector's errors
};

/** RGB-D cameras in a scene, held in the hands or mounted on a robot. A frame is one image of one
 * camera. Frames are in the order of their times. Cameras without a delay take their images at the
 * same times, one frame after the other. */
class Simulator
{
 public:
  /** Uses scene.options. \exception std::runtime_error See robotPath(). */
  Simulator(Scene scene, LabelTable labels, std::uint64_t seed);
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  std::size_t frameCount() const { return shots_.size(); }
  /** T_world_robot of each frame. */
  const std::vector<mrpt::poses::CPose3D>& truePoses() const { return T_world_robot_; }
  /** T_world_robot of each frame by odometry, which starts at the first true pose and drifts. */
  const std::vector<mrpt::poses::CPose3D>& odometry() const { return odometry_; }
  double time(std::size_t frame) const;                  //!< [s since 1970]
  const CameraOptions& camera(std::size_t frame) const;  //!< The camera of the frame
  const Scene& scene() const { return scene_; }

  /** Makes a frame. It depends on nothing but scene, random seed and index, and may run
   *  concurrently. */
  SimulatedFrame frame(std::size_t index) const;

 private:
  /** One image of one camera. */
  struct Shot
  {
    double instant;  // its time [frames of this camera since the start]
    std::size_t camera;
  };

  static std::vector<Shot> shotsOf(
      const std::vector<CameraOptions>& cameras, const TrajectoryOptions& trajectory);

  /** Motion of the robot during the exposure of each frame; empty when no camera blurs. */
  std::vector<mrpt::poses::CPose3D> motionDuringExposure(const std::vector<double>& instants) const;

  mrpt::obs::CObservation3DRangeScan::Ptr scanOf(
      const RenderedFrame& rendered, std::size_t index) const;

  Scene scene_;
  LabelTable labels_;
  std::uint64_t seed_;
  std::vector<CameraOptions> cameras_;
  std::vector<Shot> shots_;
  SimulatedDetector detector_;
  std::vector<mrpt::poses::CPose3D> T_world_robot_;
  std::vector<mrpt::poses::CPose3D> T_start_end_;  // of the robot during each exposure, if any
  std::vector<mrpt::poses::CPose3D> odometry_;
};

/** What simulateToFiles() wrote. */
struct SimulationSummary
{
  std::size_t frames = 0, boxes = 0;
  std::vector<ObjectRecord> truth;  //!< With framesVisible
};

/** Called after each frame with the share that is done, in [0, 1]. */
using Progress = std::function<void(double)>;

/** The files of a simulation: NAME.rawlog, NAME.objects.rawlog, NAME.objects.gt.json and
 * NAME.groundtruth.tum. \param rawlog Path of NAME.rawlog (or NAME.rawlog.gz). */
struct SimulationFiles
{
  explicit SimulationFiles(const std::string& rawlog);

  std::string rawlog, boxes, truth, trajectory;  //!< Their paths
};

/** A text that appears together with the files of a simulation. */
struct TextBeside
{
  std::string path, text;
};

/** Makes all frames and writes the SimulationFiles. All files appear when the last frame is done,
 * or none. \param rawlog Path of NAME.rawlog (or NAME.rawlog.gz).
 * \param beside Another file that appears with them; its path is none of theirs.
 * \exception std::runtime_error If a file cannot be written. */
SimulationSummary simulateToFiles(
    const Simulator& simulator,
    const std::string& rawlog,
    const Progress& progress = {},
    const std::optional<TextBeside>& beside = {});

}  // namespace quadmap::simulator
