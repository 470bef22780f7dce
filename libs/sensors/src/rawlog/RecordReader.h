#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "quadmap/sensors/CheckedReader.h"
#include "rawlog/RecordInput.h"

namespace quadmap
{
/** Reads the objects of a rawlog one by one. MRPT's own readers stop silently at damaged data and
 * at the first class that they do not know. This one says what happened. */
class RecordReader
{
 public:
  /** \param isStopped Asked while the next object is looked for, which then is not found.
   *  \exception std::runtime_error If the file cannot be opened. */
  explicit RecordReader(
      const std::string& file,
      const RecordLimits& limits = {},
      std::function<bool()> isStopped = [] { return false; });

  /** The next object, or null at the end of the file. That may follow an exception.
   *  \exception InputError For an object that cannot be read: its image is damaged, its class is
   *  unknown, it states sizes that cannot be right, or the file is truncated or damaged. Where the
   *  next object begins is only known in the first case. In the others the next call looks for it.
   */
  mrpt::serialization::CSerializable::Ptr next();

  bool hasEnded() const { return ended_; }  //!< Nothing more can be read: next() returns null

  const std::string& file() const { return file_; }
  std::size_t recordsRead() const { return recordsRead_; }  //!< Index of the next object
  /** From the beginnings of objects that could not be read to those found behind them. */
  std::uint64_t bytesLeftOut() const { return bytesLeftOut_; }
  double progress() const { return ended_ ? 1.0 : stream_.progress(); }

 private:
  std::string explain(const std::exception& e) const;
  mrpt::serialization::CSerializable::Ptr read();
  [[noreturn]] void throwDamaged(const DamagedImage& e);
  mrpt::serialization::CSerializable::Ptr findNext();

  std::string file_;
  RecordInput stream_;
  CheckedReader reader_;
  std::function<bool()> isStopped_;
  std::size_t recordsRead_ = 0;
  std::uint64_t bytesLeftOut_ = 0;
  bool isLost_ = false;  //!< Where the next object begins is not known
  bool ended_ = false;
};

}  // namespace quadmap
