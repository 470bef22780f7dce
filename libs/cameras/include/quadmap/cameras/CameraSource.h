#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/cameras/CameraOptions.h"
#include "quadmap/sensors/FrameSource.h"

namespace quadmap
{
class RgbdDevice;

/** The frames of an RGB-D camera, or of a recording of one.
 *
 * A camera does not wait: a thread receives its images and keeps the newest few frames, and those
 * that are not taken in time are skipped and counted. A recording waits, and gives all of its
 * frames.
 *
 * The scans have the sensor label kCameraLabel, depth and colour in the geometry of the colour
 * camera, and the time of the depth image. That of a camera is the wall time at which it arrived,
 * smoothed by the camera's clock; that of a recording, which does not know when it was made, is the
 * camera's clock counted from 1970 on. Times grow from frame to frame.
 *
 * next() ends at the end of the recording, when a limit of the options is reached, when they say
 * so, or when the camera fails, which failure() then tells. It throws for a frame that cannot be
 * understood. */
class CameraSource : public FrameSource
{
 public:
  /** \param name Of the camera, for messages, such as "openni2:live".
   *  \exception std::invalid_argument For options out of range. */
  CameraSource(const std::string& name, std::unique_ptr<RgbdDevice> device, CameraOptions options);
  ~CameraSource() override;  //!< Stops the camera

  bool isLive() const;  //!< A camera, not a recording of one
  CameraCounts counts() const;
  /** What a user should know, although it is no error: one line each. */
  std::vector<std::string> notes() const;
  std::string lossSummary() const override;

  double progress() const override;  //!< By time, number or place in the file; 0 without a limit
  std::size_t recordsRead() const override;
  const std::vector<InputProblem>& problems() const override;  //!< Always empty
  bool hasBoxes() const override { return false; }
  std::string odometryKind() const override { return {}; }
  std::string contentSummary() const override;
  std::optional<std::string> failure() const override;

 private:
  std::optional<RgbdFrame> read() override;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/** Opens a camera by OpenNI2.
 *  \param what "live", which is the first camera that OpenNI2 finds, or the name of an .oni file.
 *  \exception std::invalid_argument For options out of range.
 *  \exception std::runtime_error If it cannot be opened: no such file, no camera, no driver, or the
 *  project was built without OpenNI2. */
std::unique_ptr<CameraSource> openOpenNi2(const std::string& what, const CameraOptions& options);

/** The word that stands for the first camera. */
inline const std::string kLiveCamera = "live";

}  // namespace quadmap
