#pragma once

#include <cstddef>
#include <deque>
#include <limits>
#include <string>
#include <vector>

namespace quadmap
{
/** A record whose time is far ahead of that of a later record of its sensor. */
struct StrayRecord
{
  std::size_t record = 0;  //!< Index in its file
  std::size_t later = 0;   //!< Index of the later record
  double ahead = 0;        //!< Of the time of that one [s]

  std::string text() const;  //!< What is wrong with it
};

/** Follows the times of the records of one sensor, which must not go back.
 *
 * A record that leaves all before it far behind may have a wrong time, or the recording had a pause
 * or its clock was set. So a jump does not count before it has lasted: until ten more records have
 * followed, or for half the time that it skipped. When the time comes back before that, to where it
 * was or later, all records since the jump are strays, and the time goes on without them. */
class RecordClock
{
 public:
  /** The time of the last record that stays when one of this time follows [s]; -infinity when there
   * is none. It is later than this time when the latter is wrong: time has gone back. */
  double lastBefore(double time) const;

  /** Goes on to the next record, whose time is not before lastBefore().
   *  \return The records since a jump that did not last, in the order of the file. */
  std::vector<StrayRecord> advance(double time, std::size_t record);

  /** The time of the last record that cannot be a stray any more [s]; -infinity when there is none.
   */
  double latest() const { return latest_; }

 private:
  struct Unconfirmed
  {
    double time;
    std::size_t record;
  };

  std::size_t kept(double time) const;
  bool firstMayBeStray() const;
  void confirm();

  double latest_ = -std::numeric_limits<double>::infinity();
  std::deque<Unconfirmed> unconfirmed_;  // since a jump, in the order of time
};

}  // namespace quadmap
