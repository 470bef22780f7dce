#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace quadmap
{
/** The bytes of a file, unpacked when gzip compressed them in one or more members. zlib's gzread()
 * ignores whatever follows a member and is none, so that a damaged head of the second member ends
 * the file without a word. */
class GzipDecoder
{
 public:
  /** \exception std::runtime_error If the file cannot be opened. */
  explicit GzipDecoder(const std::string& path);
  ~GzipDecoder();
  GzipDecoder(const GzipDecoder&) = delete;
  GzipDecoder& operator=(const GzipDecoder&) = delete;

  /** Bytes of a block that turns out to be damaged are not given, as those behind the damage may
   * look sound. Reads less than `count` at the end of the file, or where it breaks off: then the
   * next call tells which. \exception std::runtime_error If the file is truncated, damaged, or goes
   * on with bytes that gzip did not compress. */
  std::size_t read(char* bytes, std::size_t count);

  std::uint64_t bytesTaken() const { return bytesRead_ - z_.avail_in; }  //!< Of the file

 private:
  bool refill();
  void unpackBlock();
  void passBlock();
  bool isMember(int state) const;
  std::string whyNot(int state) const;

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::vector<unsigned char> packed_, unpacked_;
  z_stream z_{};
  std::uint64_t bytesRead_ = 0;
  std::size_t next_ = 0, end_ = 0;  // of the unpacked bytes
  std::string failure_;             // what the next call throws when these are used up
  bool isPlain_ = false;
  bool isInMember_ = false;
  bool isFirst_ = true;  // member
};

}  // namespace quadmap
