#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/obs/LabelTable.h"
#include "quadmap/sensors/CheckedReader.h"
#include "quadmap/sensors/FrameSource.h"

namespace quadmap
{
/** How a rawlog is read. */
struct RawlogSourceOptions
{
  /** The file with the boxes (sidecar). When it is empty, NAME.objects.rawlog is used if it exists.
   */
  std::string objectsFile;
  bool readBoxes = true;  //!< Read boxes from the sidecar or the rawlog; pixelLabels aside
  /** The labels whose pixelLabels become boxes. When it is empty, pixelLabels are ignored. */
  std::optional<LabelTable> pixelLabelClasses;
  int minLabelPixels = 1;       //!< See boxesFromPixelLabels()
  std::string sensorLabel;      //!< The only RGB-D sensor to read; empty for all
  bool keepGoing = false;       //!< Leave out and note broken records instead of throwing
  double maxBoxDelay = 0.005;   //!< Most time between a scan and its boxes [s], >= 0
  double maxOdometryGap = 1.0;  //!< Longest time to interpolate poses over [s], > 0
  /** The odometry to use when there are several, named as in RawlogSource::odometryKind(). When it
   *  is empty, the first one that appears is used. */
  std::string odometryKind;
  RecordLimits limits;          //!< What a record may ask for
  bool imagesAnywhere = false;  //!< Read external images that lie outside the image folder
  std::string imagesHint;       //!< How a user sets imagesAnywhere, for messages; empty: not at all
  /** Asked before every record of the rawlog and of the boxes, as a file may have no images for
   * long. When it returns true, the source is stopped: next() gives no frame from then on. */
  std::function<bool()> shouldStop = [] { return false; };
};

/** Reads the RGB-D frames of a rawlog one by one, and pairs them with boxes and poses. It reads
 * both formats of MRPT (actions and sensory frames, or observations), compressed or not, and holds
 * only a few frames at a time.
 *
 * Boxes come from the sidecar, or from the rawlog itself when there is no sidecar or it has no
 * boxes. A scan without boxes there gets those of its pixelLabels, if it has any. Odometry of any
 * kind (CActionRobotMovement2D/3D, CObservationOdometry, CObservationRobotPose) is interpolated at
 * the frame's time. A CObservationRobotPose with the label "ground_truth" is the true pose, not
 * odometry. A CObservationRobotPose states the pose of the robot, as MRPT defines it, and not that
 * of its sensor.
 *
 * next() gives the frames in the order of the file. It throws std::runtime_error for a truncated
 * file, an unknown class, a missing external image and the like. The message is one line with file,
 * record and sensor. With keepGoing such a record is noted in problems() instead, and reading goes
 * on with the next one that is found. */
class RawlogSource : public FrameSource
{
 public:
  /** \exception std::runtime_error If the file is missing or is no rawlog. */
  RawlogSource(std::string file, RawlogSourceOptions options);
  ~RawlogSource() override;

  const std::vector<InputProblem>& problems() const override;
  double progress() const override;
  std::size_t recordsRead() const override;
  std::size_t framesRead() const;
  bool hasBoxes() const override;                  //!< There were boxes (or pixelLabels, if wanted)
  std::string odometryKind() const override;       //!< "CObservationOdometry wheels"; at first ""
  std::vector<std::string> odometryKinds() const;  //!< All kinds so far, used or not
  std::string contentSummary() const override;
  bool wasStopped() const override;

 private:
  std::optional<RgbdFrame> read() override;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quadmap
