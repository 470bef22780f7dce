#pragma once

#include <memory>
#include <optional>
#include <string>

#include "../common/CameraArguments.h"
#include "../common/StatusLine.h"
#include "quadmap/cameras/CameraSource.h"
#include "quadmap/slam/RawlogRun.h"

namespace quadmap
{
/** The camera of a run, if its input is one, and how far the run is on the terminal. */
class CameraInput
{
 public:
  /** Makes the camera the source of the run when its input is "openni2:...". Ctrl-C ends a camera,
   * and stops the run on a recording. \param run Must outlive this object. \param calibration The
   * name of a known camera, if it is set.
   *  \exception cli::UsageError For arguments that do not fit the input, or a run without boxes.
   *  \exception std::runtime_error If the camera cannot be opened. */
  CameraInput(
      RawlogRunRequest& run,
      cli::CameraArguments& arguments,
      TCLAP::ValueArg<std::string>& calibration);

  /** Call it when the run is over: what is printed next begins a new line. */
  void end() { line_.end(); }

  /** Why the camera ended before its time, if it did. */
  std::optional<std::string> failure() const { return camera_ ? camera_->failure() : std::nullopt; }

 private:
  void open(RawlogRunRequest& run, const CameraOptions& options);
  std::string stateOf(const RunProgress& progress) const;

  std::shared_ptr<CameraSource> camera_;  //!< Null when the input is a rawlog
  cli::StatusLine line_;
};

}  // namespace quadmap
