#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "RecordReader.h"
#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** Boxes waiting for their scan, either read from the sidecar as far as needed or handed in. */
class BoxBuffer
{
 public:
  struct Entry
  {
    std::size_t record = 0;
    CObservationObjects::Ptr boxes;
  };

  /** \param maxDelay Largest difference of the times of boxes and scan [s]. */
  explicit BoxBuffer(double maxDelay) : maxDelay_(maxDelay) {}

  /** Its records may stand in any order. A file without boxes counts for nothing.
   *  \exception std::runtime_error If the file cannot be opened. */
  void openSidecar(const std::string& file);
  bool hasSidecar() const { return sidecar_ != nullptr; }

  /** Reads the sidecar as far as boxes up to a time [s] can stand in it. \exception InputError */
  void readUntil(double time);

  /** \exception std::runtime_error Without time stamp. */
  void add(Entry entry);

  /** A detector takes its time: can boxes of this sensor and time [s] still turn up in the rawlog?
   *  Not before the sensor's first boxes, nor once later ones were seen. */
  bool mayStillCome(const std::string& label, double time) const;

  /** Takes out the boxes of this sensor nearest to a time [s]. */
  std::optional<Entry> take(const std::string& label, double time);

  /** Boxes of this sensor (empty: of any) that were seen and found no scan. */
  std::size_t unpaired(const std::string& label) const;
  std::size_t paired() const { return paired_; }
  bool seenAny() const { return seenAny_; }

 private:
  double maxDelay_;
  std::unique_ptr<RecordReader> sidecar_;
  std::optional<double> sidecarTime_;                 // the latest that was read [s]
  double stepBack_ = 0;                               // how far its times go back at most [s]
  std::map<std::string, std::deque<Entry>> waiting_;  // by sensor, in the order of time
  std::map<std::string, double> latest_;              // of the boxes of each sensor [s]
  std::map<std::string, std::size_t> dropped_;        // too old to find a scan, by sensor
  std::size_t paired_ = 0;
  bool seenAny_ = false;
};

}  // namespace quadmap
