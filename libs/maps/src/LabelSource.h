#pragma once

#include <mutex>
#include <utility>

#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** Where a map's label table comes from: it was given, or the installed one is read when it is
 * first asked for. Several threads may ask at the same time. */
class LabelSource
{
 public:
  LabelSource() = default;  //!< The installed table
  explicit LabelSource(LabelTable given) : isGiven_(true), table_(std::move(given)) {}

  bool isGiven() const { return isGiven_; }

  /** \exception std::runtime_error If the installed table cannot be read; the next call tries it
   *  again. */
  const LabelTable& table() const
  {
    if (!isGiven_) std::call_once(read_, [this] { table_ = LabelTable::installed(); });
    return table_;
  }

 private:
  const bool isGiven_ = false;
  mutable std::once_flag read_;
  mutable LabelTable table_;
};

}  // namespace quadmap
