#include "GzipDecoder.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace quadmap
{
namespace
{
constexpr std::size_t kBlockBytes = 1u << 17;

std::FILE* openOrThrow(const std::string& path)
{
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) throw std::runtime_error(path + ": cannot open: " + std::strerror(errno));
  std::setvbuf(file, nullptr, _IONBF, 0);  // the decoder has a buffer of its own
  return file;
}
}  // namespace

GzipDecoder::GzipDecoder(const std::string& path) :
    file_(openOrThrow(path), &std::fclose), packed_(kBlockBytes), unpacked_(kBlockBytes)
{
  constexpr int kGzipFormat = 16;  // added to zlib's window bits
  if (inflateInit2(&z_, MAX_WBITS + kGzipFormat) != Z_OK)
    throw std::runtime_error(path + ": cannot open: out of memory");
  refill();
  isPlain_ = z_.avail_in < 2 || packed_[0] != 0x1f || packed_[1] != 0x8b;
}

GzipDecoder::~GzipDecoder() { inflateEnd(&z_); }

/** \return False at the end of the file. */
bool GzipDecoder::refill()
{
  errno = 0;
  z_.next_in = packed_.data();
  z_.avail_in = static_cast<uInt>(std::fread(packed_.data(), 1, packed_.size(), file_.get()));
  bytesRead_ += z_.avail_in;
  if (z_.avail_in == 0 && std::ferror(file_.get()))
    throw std::runtime_error(std::string("the file cannot be read: ") + std::strerror(errno));
  return z_.avail_in > 0;
}

/** Whether what could not be unpacked began as gzip begins. */
bool GzipDecoder::isMember(int state) const
{
  return isFirst_ || (state == Z_OK ? z_.total_in > 1 : z_.total_out > 0);
}

std::string GzipDecoder::whyNot(int state) const
{
  if (!isMember(state)) return "the file is damaged (more than gzip wrote follows)";
  if (state == Z_OK) return "the file is truncated (its compressed data ends early)";
  return std::string("the file is damaged (") + zError(state) + ")";
}

/** Unpacks what fills a block, or less at the end of the file. What came before the end of a
 * truncated file is kept, but not what came before damage, as nobody knows where that begins. */
void GzipDecoder::unpackBlock()
{
  next_ = end_ = 0;
  z_.next_out = unpacked_.data();
  z_.avail_out = static_cast<uInt>(unpacked_.size());
  while (z_.avail_out > 0)
  {
    const bool hasMore = z_.avail_in > 0 || refill();
    if (!hasMore && !isInMember_) break;
    isInMember_ = true;
    const int state = hasMore ? inflate(&z_, Z_NO_FLUSH) : Z_OK;
    if (state == Z_STREAM_END)
    {
      isInMember_ = isFirst_ = false;
      inflateReset(&z_);
    }
    else if (!hasMore || (state != Z_OK && state != Z_BUF_ERROR))
    {
      failure_ = whyNot(state);
      if (hasMore && isMember(state)) return;
      break;
    }
  }
  end_ = unpacked_.size() - z_.avail_out;
}

/** The file's bytes as they are. */
void GzipDecoder::passBlock()
{
  next_ = end_ = 0;
  if (z_.avail_in == 0 && !refill()) return;
  end_ = z_.avail_in;
  std::memcpy(unpacked_.data(), z_.next_in, end_);
  z_.avail_in = 0;
}

std::size_t GzipDecoder::read(char* bytes, std::size_t count)
{
  std::size_t done = 0;
  while (done < count)
  {
    if (next_ == end_ && failure_.empty()) isPlain_ ? passBlock() : unpackBlock();
    const std::size_t some = std::min(count - done, end_ - next_);
    if (some == 0) break;
    std::memcpy(bytes + done, unpacked_.data() + next_, some);
    next_ += some;
    done += some;
  }
  if (done == 0 && count > 0 && !failure_.empty()) throw std::runtime_error(failure_);
  return done;
}

}  // namespace quadmap
