#pragma once

#include <mrpt/system/COutputLogger.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/obs/LabelTable.h"
#include "quadmap/sensors/RgbdFrame.h"

namespace quadmap
{
/** How a rawlog is read. */
struct RawlogSourceOptions
{
  std::string objectsFile;  //!< Sidecar with the boxes; empty: NAME.objects.rawlog when it exists
  /** The classes whose pixelLabels become boxes; nothing: pixelLabels are not looked at. */
  std::optional<LabelTable> pixelLabelClasses;
  int minLabelPixels = 1;       //!< See boxesFromPixelLabels()
  std::string sensorLabel;      //!< Only this RGB-D sensor; empty: all
  bool keepGoing = false;       //!< Drop broken records (and count them) instead of throwing
  double maxBoxDelay = 0.005;   //!< Boxes belong to a scan within this time [s], >= 0
  double maxOdometryGap = 1.0;  //!< Poses are interpolated over at most this time [s], > 0
  /** The odometry to use when there is more than one, as RawlogSource::odometryKind() names it;
   *  empty: the first that appears. */
  std::string odometryKind;
};

/** Something in the input that could not be used. */
struct InputProblem
{
  std::string file;
  std::size_t record = 0;
  std::string sensor;  //!< May be empty
  std::string what;

  std::string text() const;  //!< "file: record 12 (camera): what"
};

/** Streams the RGB-D frames of a rawlog, either MRPT format (actions + sensory frames, or
 * observations), .gz or not, paired with boxes and poses; holds only a few frames at a time.
 *
 * Boxes come from the sidecar; without one (or with one that has no boxes) from the rawlog itself.
 * A scan that has none there gets those of its pixelLabels, when it has some. Odometry of any kind
 * (CActionRobotMovement2D/3D, CObservationOdometry, CObservationRobotPose) is interpolated at the
 * frame's time; CObservationRobotPose labelled "ground_truth" is the true pose, not odometry. What
 * a CObservationRobotPose states is the robot's pose, as MRPT defines it, wherever its sensor is.
 */
class RawlogSource : public mrpt::system::COutputLogger
{
 public:
  /** \exception std::runtime_error If the file is missing or is no rawlog. */
  RawlogSource(std::string file, RawlogSourceOptions options);
  ~RawlogSource() override;

  /** The next frame in the order of the file, or nothing at the end.
   *  \exception std::runtime_error On a truncated file, an unknown class, a missing external image,
   *  and so on: one line with file, record and sensor. With keepGoing such a record becomes a
   *  problem and, where the file can be read on, reading goes on. */
  std::optional<RgbdFrame> next();

  const std::vector<InputProblem>& problems() const;  //!< What keepGoing dropped so far
  double progress() const;                            //!< Share of the file read, in [0, 1]
  std::size_t recordsRead() const;
  std::size_t framesRead() const;
  bool hasBoxes() const;             //!< Boxes (or pixelLabels, if wanted) were seen somewhere
  std::string odometryKind() const;  //!< The one used: "CObservationOdometry wheels"; "" at first
  std::vector<std::string> odometryKinds() const;  //!< All that were seen, used or not

  /** What was read so far, for messages: "812 CObservation2DRangeScan, 406 CObservationOdometry".
   */
  std::string contentSummary() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quadmap
