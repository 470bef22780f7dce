#pragma once

#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "odometry/OdometryReader.h"
#include "quadmap/sensors/RawlogSource.h"
#include "rawlog/BoxBuffer.h"
#include "rawlog/RecordReader.h"
#include "rawlog/ScanCheck.h"

namespace quadmap
{
/** A scan that waits until everything that belongs to it was read. */
struct PendingFrame
{
  RgbdFrame frame;
  mrpt::poses::CPose3DPDFGaussian sumOfActions;
  std::size_t bytes = 0;  //!< Of its images
};

struct RawlogSource::Impl
{
  Impl(RawlogSource& owner, std::string file, RawlogSourceOptions o);

  std::optional<RgbdFrame> next();
  std::string summary() const;

  /** Most time between a scan and its record [s]. Poses are kept for so long. */
  static constexpr double kMaxScanDelay = 10;

  RecordReader reader;
  RawlogSourceOptions options;
  ImageRules imageRules;
  std::vector<InputProblem> problems;
  bool stopped = false;  // by options.shouldStop()
  std::size_t framesRead = 0;
  bool sawPixelLabels = false;
  BoxBuffer boxes;
  OdometryReader odometry;

 private:
  bool isStopped();
  void report(const InputProblem& problem);
  bool readRecord();
  void readObject(std::size_t record, const mrpt::serialization::CSerializable::Ptr& object);
  void readObservation(std::size_t record, const mrpt::obs::CObservation::Ptr& observation);
  std::vector<StrayRecord> addScan(
      std::size_t record, const mrpt::obs::CObservation3DRangeScan::Ptr& scan);
  void dropPending(const StrayRecord& stray, const std::string& sensor);
  bool isReady(const PendingFrame& pending) const;
  bool posesAreKnown(const PendingFrame& pending) const;
  std::optional<RgbdFrame> complete(PendingFrame pending);
  void addPoses(PendingFrame& pending);
  void addBoxes(RgbdFrame& frame);
  void addPixelLabels(RgbdFrame& frame);
  void tellUnknownPixelLabels();
  void tellLeftOut(const std::string& file, std::uint64_t bytes);
  void readSidecar(double time);
  void finish();
  void warnOnce(const std::string& text);

  RawlogSource& log_;
  std::deque<PendingFrame> pending_;
  std::size_t pendingBytes_ = 0;                // of the images of all waiting frames
  std::map<std::string, RecordClock> clocks_;   // of the scans of each sensor
  std::map<std::string, std::size_t> content_;  // number of records by class
  std::set<std::string> warned_;
  std::set<std::string> unknownPixelLabels_;
  bool ended_ = false, finished_ = false;
};

}  // namespace quadmap
