#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

namespace quadmap
{
/** A single record whose time is far ahead of the records around it. */
struct StrayRecord
{
  std::size_t record = 0;  //!< Index in its file
  double ahead = 0;        //!< Of the next record of its sensor [s]

  std::string text() const;  //!< What is wrong with it
};

/** Follows the times of the records of one sensor, which must not go back. When they do, one of two
 * records is wrong. If the earlier one had left all before it far behind, that one is a stray, and
 * the time goes on without it. So a record that is far ahead does not count before the next one
 * confirms it. */
class RecordClock
{
 public:
  /** By how much this time is before that of the last record [s]; 0 when it is not, or when the
   * last record is a stray. */
  double stepBack(double time) const;

  /** Goes on to the next record, whose stepBack() is 0.
   *  \return The record before, if that one was a stray. */
  std::optional<StrayRecord> advance(double time, std::size_t record);

  /** The time of the last record that cannot be a stray any more [s]; -infinity when there is none.
   */
  double latest() const { return latest_; }

  /** The time of the last record [s]; -infinity when there is none. */
  double last() const { return unconfirmed_ ? unconfirmed_->time : latest_; }

 private:
  bool lastIsStray(double next) const;

  struct Unconfirmed
  {
    double time;
    std::size_t record;
  };
  double latest_ = -std::numeric_limits<double>::infinity();
  std::optional<Unconfirmed> unconfirmed_;  //!< The last record, when it is far ahead of latest_
};

}  // namespace quadmap
