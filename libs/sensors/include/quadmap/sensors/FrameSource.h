#pragma once

#include <mrpt/system/COutputLogger.h>

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/sensors/RgbdFrame.h"

namespace quadmap
{
/** Something in the input that could not be used. */
struct InputProblem
{
  std::string file;
  std::size_t record = 0;
  std::string sensor;  //!< May be empty
  std::string what;

  std::string text() const;  //!< "file: record 12 (camera): what"
};

/** For messages about the images of one sensor: " of a sensor \"front\"", or "" for any. */
std::string ofSensor(const std::string& sensorLabel);

/** What gives the RGB-D frames of a run one by one: a recording, or a camera. */
class FrameSource : public mrpt::system::COutputLogger
{
 public:
  using COutputLogger::COutputLogger;

  /** The next frame in the order of the source, or nothing at its end, or when it was stopped.
   *  \exception std::runtime_error For a frame that cannot be used. */
  std::optional<RgbdFrame> next();

  /** Hands warnings on, one line each, instead of writing them to the terminal in MRPT's form. Call
   * it once; the receiver is used as long as the source is. */
  void sendWarningsTo(std::function<void(const std::string&)> receiver);

  /** Puts frames back, whose first is what next() gives next. */
  void giveBack(const std::vector<RgbdFrame>& frames);

  virtual double progress() const = 0;          //!< Share that was read, in [0, 1]
  virtual std::size_t recordsRead() const = 0;  //!< Number of records or images that were read
  virtual const std::vector<InputProblem>& problems() const = 0;  //!< What was left out so far
  virtual bool hasBoxes() const = 0;                              //!< Some frame so far had boxes
  virtual std::string odometryKind() const = 0;  //!< Class and label of its odometry, or ""

  /** What was read so far, for messages: "812 CObservation2DRangeScan, 406 CObservationOdometry".
   */
  virtual std::string contentSummary() const = 0;

  /** What to tell the user when no frame came.
   *  \param sensorLabel Of the only sensor that was wanted; may be empty. */
  std::string whyNoFrames(const std::string& sensorLabel = {}) const;

  /** Somebody stopped it, so that no frame comes although there may be more. */
  virtual bool wasStopped() const { return false; }

  /** Why the source ended before its time, such as a camera that was unplugged; nothing when it
   * did not. The frames before are good. */
  virtual std::optional<std::string> failure() const { return std::nullopt; }

  /** What did not reach the program, "3 frames skipped, 1 lost by the camera"; empty when all did.
   */
  virtual std::string lossSummary() const { return {}; }

 protected:
  virtual std::optional<RgbdFrame> read() = 0;  //!< As next()

 private:
  std::deque<RgbdFrame> givenBack_;
};

}  // namespace quadmap
