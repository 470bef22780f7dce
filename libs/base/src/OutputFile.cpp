#include "quadmap/base/OutputFile.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "FileSystem.h"
#include "quadmap/base/OutputSet.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

/** Less free space than this means that the last write may have failed [bytes]. */
constexpr unsigned long long kFullDisk = 4096;

/** `.objects.json.4711.tmp.json` for objects.json; compressed files keep both extensions. */
fs::path temporaryFor(const fs::path& finalPath, unsigned attempt)
{
  std::string extension = finalPath.extension().string();
  if (extension == ".gz") extension = finalPath.stem().extension().string() + extension;
  std::string name = "." + finalPath.filename().string() + "." + std::to_string(::getpid());
  if (attempt > 0) name += "-" + std::to_string(attempt);
  return finalPath.parent_path() / (name + ".tmp" + extension);
}

/** Creates an empty file that did not exist before, next to its final name.
 *  \param permissions Of the file that it will replace, if there is one: what others may not read
 *  they may not read while it is written either. */
std::string createTemporary(const fs::path& finalPath, std::optional<mode_t> permissions)
{
  constexpr unsigned kAttempts = 100;
  for (unsigned attempt = 0; attempt < kAttempts; ++attempt)
  {
    const std::string path = temporaryFor(finalPath, attempt).string();
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0)
    {
      if (permissions) ::fchmod(file, *permissions | S_IWUSR);  // writers open it by its name
      ::close(file);
      return path;
    }
    if (errno != EEXIST) failToWrite(finalPath.string(), errno);
  }
  failToWrite(finalPath.string(), EEXIST);
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

OutputFile::OutputFile(std::string finalPath)
{
  if (finalPath.empty()) throw std::runtime_error("output file: the name is empty");
  std::error_code ignored;
  const fs::path target = withoutLink(finalPath);
  if (fs::is_directory(target, ignored)) failToWrite(finalPath, EISDIR);
  target_ = target.string();
  finalPath_ = pathAfterCommit(target_);
  temporaryPath_ = target_;
  if (isDevice(target)) return;
  permissions_ = permissionsOf(target);
  const auto pause = Temporary::pause();
  temporaryPath_ = createTemporary(target, permissions_);
  temporary_.emplace(temporaryPath_);
}

void OutputFile::commit()
{
  if (!temporary_) return;
  if (const int error = flushToDisk(temporaryPath_); error != 0) failToWrite(target_, error);
  if (permissions_) ::chmod(temporaryPath_.c_str(), *permissions_);
  if (::rename(temporaryPath_.c_str(), target_.c_str()) != 0) failToWrite(target_, errno);
  temporary_->keep();
  temporary_.reset();
  syncFolder(fs::path(target_).parent_path());
}

void writeTextFile(const std::string& path, const std::string& text)
{
  OutputFile output(path);
  std::FILE* file = std::fopen(output.temporaryPath().c_str(), "wb");
  if (!file) failToWrite(path, errno);
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const int writeError = errno;
  const bool closed = std::fclose(file) == 0;  // flushes: the other place a full disk shows
  if (!written) failToWrite(path, writeError);
  if (!closed) failToWrite(path, errno);
  output.commit();
}

}  // namespace quadmap
