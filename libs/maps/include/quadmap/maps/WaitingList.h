#pragma once

#include <mrpt/core/Clock.h>

#include <deque>
#include <vector>

#include "quadmap/estimation/ObjectView.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
struct WaitingOptions
{
  int capacity = 100;         //!< Partial measurements kept, >= 1
  int minViews = 3;           //!< That must agree before they start an object, >= 2
  double minParallax = 0.14;  //!< Largest angle between their rays [rad]; INI key in degrees
  double gateShare = 0.5;     //!< They agree within this share of the typical size + 0.1 m, > 0
};

/** Partial measurements that no object explains. Several that agree start an object, if each is
 * from another image and the directions fix the distance. */
class WaitingList
{
 public:
  struct Entry
  {
    ObjectView view;
    mrpt::Clock::time_point time;
    double boxSize = 0;  //!< Smaller side of its box [px]
  };

  /** Keeps the measurement, or returns (and forgets) all those that make an object together with
   *  it. */
  std::vector<Entry> add(Entry entry, const LabelTable& labels, const WaitingOptions& options);

  void clear() { entries_.clear(); }
  std::size_t size() const { return entries_.size(); }

 private:
  std::deque<Entry> entries_;
};

}  // namespace quadmap
