#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <cstddef>
#include <memory>
#include <string>

#include "quadmap/base/GzipInput.h"
#include "quadmap/sensors/CheckedReader.h"

namespace quadmap
{
/** Reads the objects of a rawlog one by one. MRPT's own readers stop silently at damaged data and
 * at the first class that they do not know. This one says what happened. */
class RecordReader
{
 public:
  /** \exception std::runtime_error If the file cannot be opened. */
  explicit RecordReader(const std::string& file, const RecordLimits& limits = {});

  /** The next object, or null at the clean end of the file.
   *  \exception InputError For an object with a damaged image, and if reading cannot go on, because
   *  of an unknown class or because the file is truncated or damaged: see hasEnded(). */
  mrpt::serialization::CSerializable::Ptr next();

  bool hasEnded() const { return ended_; }  //!< Nothing more can be read: next() returns null

  const std::string& file() const { return file_; }
  std::size_t recordsRead() const { return recordsRead_; }  //!< Index of the next object
  double progress() const { return ended_ ? 1.0 : stream_.progress(); }

 private:
  std::string explain(const std::exception& e) const;

  std::string file_;
  GzInput stream_;
  CheckedReader reader_;
  std::size_t recordsRead_ = 0;
  bool ended_ = false;
};

}  // namespace quadmap
