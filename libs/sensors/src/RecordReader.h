#pragma once

#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/CSerializable.h>

#include <cstddef>
#include <memory>
#include <string>

#include "GzStream.h"

namespace quadmap
{
/** Reads the objects of a rawlog one by one. MRPT's own readers stop silently at the first class
 * they do not know and at damaged data; this one says what happened. */
class RecordReader
{
 public:
  /** \exception std::runtime_error If the file cannot be opened. */
  explicit RecordReader(const std::string& file);

  /** The next object, null at the clean end of the file.
   *  \exception InputError If there is no reading on: an unknown class, a truncated or damaged
   *  file. Afterwards next() returns null. */
  mrpt::serialization::CSerializable::Ptr next();

  const std::string& file() const { return file_; }
  std::size_t recordsRead() const { return recordsRead_; }  //!< The next object's index
  double progress() const { return ended_ ? 1.0 : stream_.progress(); }

 private:
  std::string explain(const std::exception& e) const;

  std::string file_;
  GzInput stream_;
  mrpt::serialization::CArchive::UniquePtr archive_;
  std::size_t recordsRead_ = 0;
  bool ended_ = false;
};

}  // namespace quadmap
