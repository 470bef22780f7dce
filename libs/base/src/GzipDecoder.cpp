#include "GzipDecoder.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace quadmap
{
namespace
{
constexpr std::size_t kBufferBytes = 1u << 17;
constexpr std::size_t kMostAtOnce = 1u << 30;  // zlib counts in unsigned int

std::FILE* openOrThrow(const std::string& path)
{
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) throw std::runtime_error(path + ": cannot open: " + std::strerror(errno));
  std::setvbuf(file, nullptr, _IONBF, 0);  // the decoder has a buffer of its own
  return file;
}
}  // namespace

GzipDecoder::GzipDecoder(const std::string& path) :
    file_(openOrThrow(path), &std::fclose), buffer_(kBufferBytes)
{
  constexpr int kGzipFormat = 16;  // added to zlib's window bits
  if (inflateInit2(&z_, MAX_WBITS + kGzipFormat) != Z_OK)
    throw std::runtime_error(path + ": cannot open: out of memory");
  refill();
  isPlain_ = z_.avail_in < 2 || buffer_[0] != 0x1f || buffer_[1] != 0x8b;
}

GzipDecoder::~GzipDecoder() { inflateEnd(&z_); }

/** \return False at the end of the file. */
bool GzipDecoder::refill()
{
  errno = 0;
  z_.next_in = buffer_.data();
  z_.avail_in = static_cast<uInt>(std::fread(buffer_.data(), 1, buffer_.size(), file_.get()));
  bytesRead_ += z_.avail_in;
  if (z_.avail_in == 0 && std::ferror(file_.get()))
    throw std::runtime_error(std::string("the file cannot be read: ") + std::strerror(errno));
  return z_.avail_in > 0;
}

std::size_t GzipDecoder::copyPlain(char* bytes, std::size_t count)
{
  std::size_t done = 0;
  while (done < count && (z_.avail_in > 0 || refill()))
  {
    const std::size_t some = std::min<std::size_t>(count - done, z_.avail_in);
    std::memcpy(bytes + done, z_.next_in, some);
    z_.next_in += some;
    z_.avail_in -= static_cast<uInt>(some);
    done += some;
  }
  return done;
}

std::string GzipDecoder::whyNot(int state) const
{
  const bool isMember = isFirst_ || (state == Z_OK ? z_.total_in > 1 : z_.total_out > 0);
  if (!isMember) return "the file is damaged (more than gzip wrote follows)";
  if (state == Z_OK) return "the file is truncated (its compressed data ends early)";
  return std::string("the file is damaged (") + zError(state) + ")";
}

std::size_t GzipDecoder::read(char* bytes, std::size_t count)
{
  if (isPlain_) return copyPlain(bytes, count);
  std::size_t done = 0;
  while (done < count)
  {
    const bool hasMore = z_.avail_in > 0 || refill();
    if (!hasMore && !isInMember_) break;
    isInMember_ = true;
    const auto room = static_cast<uInt>(std::min(count - done, kMostAtOnce));
    z_.next_out = reinterpret_cast<Bytef*>(bytes + done);
    z_.avail_out = room;
    const int state = hasMore ? inflate(&z_, Z_NO_FLUSH) : Z_OK;
    done += room - z_.avail_out;
    if (state == Z_STREAM_END)
    {
      isInMember_ = isFirst_ = false;
      inflateReset(&z_);
    }
    else if (!hasMore || (state != Z_OK && state != Z_BUF_ERROR))
    {
      if (done > 0) break;  // what came before is still delivered
      throw std::runtime_error(whyNot(state));
    }
  }
  return done;
}

}  // namespace quadmap
