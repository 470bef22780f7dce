#include "quadmap/base/GzipInput.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "quadmap/base/InputFile.h"
#include "quadmap/base/OutputSet.h"

namespace quadmap
{
namespace
{
constexpr unsigned kBufferBytes = 1u << 17;
constexpr std::size_t kChunkBytes = 1u << 30;  // zlib counts in unsigned int

gzFile openOrThrow(const std::string& path)
{
  errno = 0;
  gzFile file = gzopen(path.c_str(), "rb");
  if (!file)
    throw std::runtime_error(
        path + ": cannot open: " + (errno ? std::strerror(errno) : "out of memory"));
  gzbuffer(file, kBufferBytes);
  return file;
}

std::string errorText(int zlibError)
{
  if (zlibError == Z_ERRNO) return std::strerror(errno);
  return zError(zlibError);
}

/** Where the last part ends that gzip compressed. gzread() ignores what follows it. */
std::uint64_t endOfCompressed(const std::string& path)
{
  constexpr int kGzipFormat = 16;  // added to zlib's window bits
  z_stream z{};
  if (inflateInit2(&z, MAX_WBITS + kGzipFormat) != Z_OK)
    throw std::runtime_error("zlib: out of memory");
  std::ifstream file(path, std::ios::binary);
  std::vector<char> in(kBufferBytes), out(kBufferBytes);
  std::uint64_t read = 0, end = 0;
  for (int state = Z_OK; state == Z_OK;)
  {
    if (z.avail_in == 0)
    {
      file.read(in.data(), static_cast<std::streamsize>(in.size()));
      z.next_in = reinterpret_cast<Bytef*>(in.data());
      z.avail_in = static_cast<uInt>(file.gcount());
      read += z.avail_in;
    }
    z.next_out = reinterpret_cast<Bytef*>(out.data());
    z.avail_out = kBufferBytes;
    state = inflate(&z, Z_NO_FLUSH);
    if (state != Z_STREAM_END) continue;
    end = read - z.avail_in;
    state = inflateReset(&z);
  }
  inflateEnd(&z);
  return end;
}
}  // namespace

GzInput::GzInput(const std::string& path, bool isResult) : path_(path)
{
  if (std::filesystem::is_directory(path))
    throw std::runtime_error(path + ": is a directory, not a file");
  requireNoDevice(path);
  if (isResult) requireOneRun(path);
  file_ = openOrThrow(path);
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  fileBytes_ = unknown ? 0 : size;
}

GzInput::~GzInput() { gzclose_r(file_); }

void GzInput::startRecord()
{
  recordBytes_ = 0;
  head_.clear();
}

double GzInput::progress() const
{
  if (fileBytes_ == 0) return 1.0;
  const auto offset = static_cast<double>(std::max<z_off_t>(gzoffset(file_), 0));
  return std::clamp(offset / static_cast<double>(fileBytes_), 0.0, 1.0);
}

void GzInput::fail(const std::string& why)
{
  failure_ = why;
  throw std::runtime_error(why);
}

/** Less than `count` at the end of the file, or where it breaks off: then the next call fails. */
std::size_t GzInput::readAvailable(char* bytes, std::size_t count)
{
  std::size_t done = 0;
  while (done < count)
  {
    const auto want = static_cast<unsigned>(std::min(count - done, kChunkBytes));
    const int got = gzread(file_, bytes + done, want);
    int error = Z_OK;
    gzerror(file_, &error);
    const bool endsEarly = error == Z_BUF_ERROR;  // what came before the end is still delivered
    if (got > 0 && static_cast<unsigned>(got) < want) return done + static_cast<std::size_t>(got);
    if (endsEarly && got == 0) fail("the file is truncated (its compressed data ends early)");
    if (got < 0 && done > 0) return done;
    if (got < 0 || (error != Z_OK && error != Z_STREAM_END && !endsEarly))
      fail("the file is damaged (" + errorText(error) + ")");
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

std::size_t GzInput::Read(void* buffer, std::size_t count)
{
  if (!failure_.empty()) throw std::runtime_error(failure_);
  auto* bytes = static_cast<char*>(buffer);
  std::size_t done = readSome(bytes, count);
  if (done > 0 && done < count) done += readSome(bytes + done, count - done);
  if (done < count && (done > 0 || recordBytes_ > 0))
    fail("the file is truncated (it ends within a record)");
  if (head_.size() < kHeadBytes) head_.append(bytes, std::min(done, kHeadBytes - head_.size()));
  recordBytes_ += done;
  return done;
}

std::size_t GzInput::readSome(char* bytes, std::size_t count)
{
  requireRoomFor(count);
  const std::size_t done = readAvailable(bytes, count);
  position_ += done;
  return done;
}

void GzInput::requireRoomFor(std::uint64_t count)
{
  if (position_ > mostBytes_ || count > mostBytes_ - position_)
    fail("the file holds more than " + std::to_string(mostBytes_ >> 20) + " MB");
}

std::uint64_t GzInput::skipToEnd()
{
  const std::uint64_t start = position_;
  std::vector<char> bytes(kBufferBytes);
  std::size_t done = bytes.size();
  while (done > 0)
  {
    done = readAvailable(bytes.data(), bytes.size());
    requireRoomFor(done);
    position_ += done;
  }
  return position_ - start;
}

std::uint64_t GzInput::bytesBehind() const
{
  return gzdirect(file_) ? 0 : fileBytes_ - endOfCompressed(path_);
}

std::size_t GzInput::Write(const void*, std::size_t)
{
  throw std::logic_error("GzInput: is read only");
}

std::uint64_t GzInput::Seek(std::int64_t, TSeekOrigin)
{
  throw std::logic_error("GzInput: cannot seek");
}

}  // namespace quadmap
