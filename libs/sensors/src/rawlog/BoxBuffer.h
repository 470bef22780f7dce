#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "quadmap/obs/CObservationObjects.h"
#include "rawlog/RecordReader.h"

namespace quadmap
{
/** Boxes that wait for their scan. They are read from the sidecar, only as far as needed, or are
 * given by add(). */
class BoxBuffer
{
 public:
  struct Entry
  {
    std::size_t record = 0;
    CObservationObjects::Ptr boxes;
  };

  /** \param maxDelay Largest difference of the times of boxes and scan [s].
   *  \param isStopped Asked before every record of the sidecar, of which no more is read from then
   *  on. */
  BoxBuffer(double maxDelay, std::function<bool()> isStopped) :
      maxDelay_(maxDelay), isStopped_(std::move(isStopped))
  {
  }

  /** Opens a sidecar, whose records may be in any order. A file without boxes is ignored.
   *  \exception std::runtime_error If the file cannot be opened. */
  void openSidecar(const std::string& file, const RecordLimits& limits);
  bool hasSidecar() const { return sidecar_ != nullptr; }
  /** See RecordReader; of the sidecar, as far as it was read. */
  std::uint64_t bytesLeftOut() const { return sidecar_ ? sidecar_->bytesLeftOut() : 0; }

  /** Reads the sidecar as far as it may contain boxes up to a time [s].
   *  \exception InputError If it is broken. */
  void readUntil(double time);

  /** Adds boxes. \exception std::runtime_error If they have no time stamp. */
  void add(Entry entry);

  /** Whether boxes of this sensor and time [s] may still follow in the rawlog, as a detector takes
   *  its time. They may not before the first boxes of the sensor, nor after later ones. */
  bool mayStillCome(const std::string& label, double time) const;

  /** Takes out the boxes of this sensor that are nearest to a time [s]. */
  std::optional<Entry> take(const std::string& label, double time);

  /** Number of boxes of this sensor (of any when it is empty) that found no scan. */
  std::size_t unpaired(const std::string& label) const;
  std::size_t paired() const { return paired_; }
  bool seenAny() const { return seenAny_; }

 private:
  Entry takeOut(const std::string& label, std::deque<Entry>::iterator at);
  void dropFirst(const std::string& label);

  double maxDelay_;
  std::function<bool()> isStopped_;
  std::unique_ptr<RecordReader> sidecar_;
  std::optional<double> sidecarTime_;                 // latest time that was read [s]
  double stepBack_ = 0;                               // most by which its times go back [s]
  std::map<std::string, std::deque<Entry>> waiting_;  // by sensor, in the order of time
  std::map<std::string, double> latest_;              // time of the last boxes, by sensor [s]
  std::map<std::string, std::size_t> dropped_;  // number of boxes that found no scan, by sensor
  std::size_t waitingBytes_ = 0;                // memory of all that wait
  std::size_t paired_ = 0;
  bool seenAny_ = false;
};

}  // namespace quadmap
