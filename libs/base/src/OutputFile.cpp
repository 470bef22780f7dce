#include "quadmap/base/OutputFile.h"

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

/** Less free space than this means that the last write may have failed [bytes]. */
constexpr unsigned long long kFullDisk = 4096;

[[noreturn]] void fail(const std::string& path, int error)
{
  throw std::runtime_error(path + ": cannot be written: " + std::strerror(error));
}

/** `.objects.json.4711.tmp.json` for objects.json; compressed files keep both extensions. */
fs::path temporaryFor(const fs::path& finalPath, unsigned attempt)
{
  std::string extension = finalPath.extension().string();
  if (extension == ".gz") extension = finalPath.stem().extension().string() + extension;
  std::string name = "." + finalPath.filename().string() + "." + std::to_string(::getpid());
  if (attempt > 0) name += "-" + std::to_string(attempt);
  return finalPath.parent_path() / (name + ".tmp" + extension);
}

/** Creates an empty file that did not exist before, next to its final name. */
std::string createTemporary(const fs::path& finalPath)
{
  constexpr unsigned kAttempts = 100;
  for (unsigned attempt = 0; attempt < kAttempts; ++attempt)
  {
    const std::string path = temporaryFor(finalPath, attempt).string();
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0)
    {
      ::close(file);
      return path;
    }
    if (errno != EEXIST) fail(finalPath.string(), errno);
  }
  fail(finalPath.string(), EEXIST);
}

/** Is the file's file system full? Unknown counts as no. */
bool diskIsFull(int file)
{
  struct statvfs s;
  if (::fstatvfs(file, &s) != 0 || s.f_blocks == 0) return false;
  const auto blocks = ::geteuid() == 0 ? s.f_bfree : s.f_bavail;
  return static_cast<unsigned long long>(blocks) * s.f_frsize < kFullDisk;
}

/** \return 0, or the error that kept the data from reaching the disk. */
int flushToDisk(const std::string& path)
{
  const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) return errno;
  int error = ::fsync(file) == 0 ? 0 : errno;
  if (error == 0 && diskIsFull(file)) error = ENOSPC;
  ::close(file);
  return error;
}

}  // namespace

OutputFile::OutputFile(std::string finalPath) : finalPath_(std::move(finalPath))
{
  if (finalPath_.empty()) throw std::runtime_error("output file: the name is empty");
  std::error_code ignored;
  const fs::path target =
      fs::is_symlink(finalPath_, ignored) ? fs::weakly_canonical(finalPath_) : fs::path(finalPath_);
  const auto type = fs::status(target, ignored).type();
  if (type == fs::file_type::directory) fail(finalPath_, EISDIR);
  isDevice_ = type == fs::file_type::character || type == fs::file_type::fifo ||
              type == fs::file_type::block || type == fs::file_type::socket;
  finalPath_ = target.string();
  temporaryPath_ = isDevice_ ? finalPath_ : createTemporary(target);
}

OutputFile::~OutputFile()
{
  if (!committed_ && !isDevice_) ::unlink(temporaryPath_.c_str());
}

void OutputFile::commit()
{
  if (committed_) return;
  if (!isDevice_)
  {
    if (const int error = flushToDisk(temporaryPath_); error != 0) fail(finalPath_, error);
    if (::rename(temporaryPath_.c_str(), finalPath_.c_str()) != 0) fail(finalPath_, errno);
  }
  committed_ = true;
}

void writeTextFile(const std::string& path, const std::string& text)
{
  OutputFile output(path);
  std::FILE* file = std::fopen(output.temporaryPath().c_str(), "wb");
  if (!file) fail(path, errno);
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const int writeError = errno;
  const bool closed = std::fclose(file) == 0;  // flushes: the other place a full disk shows
  if (!written) fail(path, writeError);
  if (!closed) fail(path, errno);
  output.commit();
}

}  // namespace quadmap
