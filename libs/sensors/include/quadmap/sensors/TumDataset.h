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
/** The content of calibration.yaml. */
struct TumCalibration
{
  mrpt::img::TCamera camera;               //!< Calibration of colour and (registered) depth
  double depthFactor = 5000;               //!< Depth [m] = pixel value / depthFactor
  std::optional<Eigen::Vector3d> worldUp;  //!< Unit vector in the world of groundtruth.txt
};

/** A colour image and its depth image. */
struct TumFrame
{
  double time = 0;           //!< Time of the depth image, which gives the geometry [s]
  std::string color, depth;  //!< Full paths
  std::string listed;        //!< The place in the lists, "associations.txt:12"
};

struct TumDatasetOptions
{
  std::string detections;             //!< Folder of the boxes; if empty, DIR/detections
  double maxAssociationDelay = 0.02;  //!< Most time from colour to depth image [s], > 0
  double maxPoseGap = 0.1;            //!< Longest time to interpolate poses over [s], > 0
};

/** A recording in the layout of the TUM RGB-D benchmark: rgb.txt, depth.txt, associations.txt,
 * groundtruth.txt, calibration.yaml, and a detector's boxes in detections/NAME.txt (`class_id
 * class_name score x1 y1 x2 y2` per line). When associations.txt is missing, images are associated
 * by their times.
 *
 * Poses come out as T_world_robot. The robot's frame is the sensor's (x forward, z up), and the
 * world is turned so that the calibration's world_up is +z. */
class TumDataset
{
 public:
  /** Reads the lists and the calibration, but no images.
   *  \exception std::runtime_error If one is missing or malformed. The message names file and line.
   */
  explicit TumDataset(std::string folder, TumDatasetOptions options = {});

  const std::string& folder() const { return folder_; }
  const TumCalibration& calibration() const { return calibration_; }
  const std::vector<TumFrame>& frames() const { return frames_; }
  const Trajectory& trajectory() const { return trajectory_; }  //!< As in the file; may be empty
  bool hasDetections() const { return !detections_.empty(); }
  /** What a user should know, although it is no error. */
  const std::vector<std::string>& notes() const { return notes_; }

  /** Loads the images of a frame. \exception std::runtime_error If one is missing, unreadable or of
   *  another size than the calibration. */
  mrpt::obs::CObservation3DRangeScan::Ptr scan(std::size_t frame) const;

  /** The boxes of a frame as they are in the file, or null when there is no file for the frame.
   *  \exception std::runtime_error For a malformed file. The message names file and line. */
  CObservationObjects::Ptr boxes(std::size_t frame) const;
  std::string boxesFile(std::size_t frame) const;

  /** The true pose, or nothing when groundtruth.txt does not cover the frame's time. */
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

}  // namespace quadmap
