#include "quadmap/base/GzipInput.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "GzipDecoder.h"
#include "quadmap/base/InputFile.h"
#include "quadmap/base/OutputSet.h"

namespace quadmap
{
GzInput::GzInput(const std::string& path, bool isResult)
{
  if (std::filesystem::is_directory(path))
    throw std::runtime_error(path + ": is a directory, not a file");
  requireNoDevice(path);
  if (isResult) requireOneRun(path);
  decoder_ = std::make_unique<GzipDecoder>(path);
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  fileBytes_ = unknown ? 0 : size;
}

GzInput::~GzInput() = default;

void GzInput::startRecord()
{
  recordBytes_ = 0;
  head_.clear();
}

double GzInput::progress() const
{
  if (fileBytes_ == 0) return 1.0;
  const auto taken = static_cast<double>(decoder_->bytesTaken());
  return std::clamp(taken / static_cast<double>(fileBytes_), 0.0, 1.0);
}

void GzInput::fail(const std::string& why)
{
  failure_ = why;
  throw std::runtime_error(why);
}

/** Less than `count` at the end of the file, or where it breaks off: then the next call fails. */
std::size_t GzInput::readAvailable(char* bytes, std::size_t count)
{
  try
  {
    return decoder_->read(bytes, count);
  }
  catch (const std::runtime_error& e)
  {
    fail(e.what());
  }
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
  const std::uint64_t room = mostBytes_ - std::min(mostBytes_, position_);
  // One byte more tells whether there are more than there may be.
  const std::size_t most = count <= room ? count : static_cast<std::size_t>(room) + 1;
  const std::size_t done = readAvailable(bytes, most);
  position_ += done;
  if (position_ > mostBytes_)
    fail("the file holds more than " + std::to_string(mostBytes_ >> 20) + " MB");
  return done;
}

std::uint64_t GzInput::skipToEnd()
{
  constexpr std::size_t kAtOnce = 1u << 17;
  const std::uint64_t start = position_;
  std::vector<char> bytes(kAtOnce);
  while (readSome(bytes.data(), bytes.size()) > 0)
  {
  }
  return position_ - start;
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
