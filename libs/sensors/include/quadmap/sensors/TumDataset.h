#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/obs/Trajectory.h"

namespace quadmap
{
/** What calibration.yaml says. */
struct TumCalibration
{
  mrpt::img::TCamera camera;               //!< Of colour and (registered) depth images
  double depthFactor = 5000;               //!< Depth [m] = pixel value / depthFactor
  std::optional<Eigen::Vector3d> worldUp;  //!< Unit vector in the world of groundtruth.txt
};

/** A colour image and its depth image. */
struct TumFrame
{
  double time = 0;           //!< Of the depth image [s]: it gives the geometry
  std::string color, depth;  //!< Full paths
  std::string listed;        //!< Where it is listed, "associations.txt:12"
};

struct TumDatasetOptions
{
  std::string detections;             //!< Folder of the boxes; empty: DIR/detections if it exists
  double maxAssociationDelay = 0.02;  //!< Between colour and depth image [s], > 0
  double maxPoseGap = 0.1;            //!< Poses are interpolated over at most this time [s], > 0
};

/** A recording in the layout of the TUM RGB-D benchmark: rgb.txt, depth.txt, associations.txt (made
 * from the times where missing), groundtruth.txt, calibration.yaml, and a detector's boxes in
 * detections/NAME.txt (`class_id class_name score x1 y1 x2 y2` per line).
 *
 * Poses come out as T_world_robot with the robot frame = sensor frame (x forward, z up) and the
 * world rotated so that the calibration's world_up is +z. */
class TumDataset
{
 public:
  /** Reads the lists and the calibration, no images.
   *  \exception std::runtime_error If one is missing or malformed; names file and line. */
  explicit TumDataset(std::string folder, TumDatasetOptions options = {});

  const std::string& folder() const { return folder_; }
  const TumCalibration& calibration() const { return calibration_; }
  const std::vector<TumFrame>& frames() const { return frames_; }
  const Trajectory& trajectory() const { return trajectory_; }  //!< As in the file; may be empty
  bool hasDetections() const { return !detections_.empty(); }
  /** What a user should know although it is no error. */
  const std::vector<std::string>& notes() const { return notes_; }

  /** Loads the images of a frame. \exception std::runtime_error If one is missing, unreadable or of
   *  another size than the calibration. */
  mrpt::obs::CObservation3DRangeScan::Ptr scan(std::size_t frame) const;

  /** The boxes of a frame, as they are in the file; null when there is no file for it.
   *  \exception std::runtime_error For a malformed file; names file and line. */
  CObservationObjects::Ptr boxes(std::size_t frame) const;
  std::string boxesFile(std::size_t frame) const;

  /** Nothing when groundtruth.txt does not cover the frame's time. */
  std::optional<mrpt::poses::CPose3D> T_world_robot(std::size_t frame) const;

 private:
  void requireTrajectoryInOrder() const;

  std::string folder_;
  TumDatasetOptions options_;
  std::string detections_;  // folder; empty: there are none
  TumCalibration calibration_;
  std::vector<TumFrame> frames_;
  Trajectory trajectory_;
  mrpt::poses::CPose3D T_zup_world_;
  std::vector<std::string> notes_;
};

/** Sensor label of imported and simulated RGB-D frames. */
inline const std::string kCameraLabel = "camera";

}  // namespace quadmap
