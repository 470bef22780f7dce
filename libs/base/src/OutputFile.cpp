#include "quadmap/base/OutputFile.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "FileSystem.h"
#include "quadmap/base/OutputSet.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

/** Less free space than this means that the last write may have failed [bytes]. */
constexpr unsigned long long kFullDisk = 4096;

/** What the names of the temporary files of one final name begin and end with, around the number
 * of the process. Compressed files keep both extensions. */
struct TemporaryName
{
  explicit TemporaryName(const fs::path& finalPath)
  {
    std::string extension = finalPath.extension().string();
    if (extension == ".gz") extension = finalPath.stem().extension().string() + extension;
    begin = "." + finalPath.filename().string() + ".";
    end = ".tmp" + extension;
  }

  /** Is it the name of a temporary file, of whichever process? */
  bool matches(const std::string& name) const
  {
    if (name.size() <= begin.size() + end.size() || name.compare(0, begin.size(), begin) != 0 ||
        name.compare(name.size() - end.size(), end.size(), end) != 0)
      return false;
    const std::string middle = name.substr(begin.size(), name.size() - begin.size() - end.size());
    return middle.find_first_not_of("0123456789-") == std::string::npos;
  }

  std::string begin, end;
};

/** `.objects.json.4711.tmp.json` for objects.json. */
fs::path temporaryFor(const fs::path& finalPath, unsigned attempt)
{
  const TemporaryName name(finalPath);
  std::string process = std::to_string(::getpid());
  if (attempt > 0) process += "-" + std::to_string(attempt);
  return finalPath.parent_path() / (name.begin + process + name.end);
}

/** Locks a file. \return False when another program has locked it, or it lost its name meanwhile.
 * \param unlockable What to return where files cannot be locked. */
bool lockNamed(int file, const std::string& path, bool unlockable)
{
  if (::flock(file, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK && unlockable;
  struct stat locked, named;
  return ::fstat(file, &locked) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         locked.st_ino == named.st_ino && locked.st_dev == named.st_dev;
}

/** Removes the temporary files of programs that were killed: those that nobody has locked. */
void removeLeftOver(const fs::path& finalPath)
{
  if (pathAfterCommit(finalPath.string()) != finalPath) return;  // OutputSet empties its folder
  const TemporaryName name(finalPath);
  const fs::path folder = finalPath.parent_path();
  std::error_code error;
  for (fs::directory_iterator it(folder.empty() ? "." : folder, error), end; !error && it != end;
       it.increment(error))
  {
    std::error_code ignored;
    if (!name.matches(it->path().filename().string()) ||
        it->symlink_status(ignored).type() != fs::file_type::regular)
      continue;
    const std::string path = it->path().string();
    const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) continue;
    if (lockNamed(file, path, false)) ::unlink(path.c_str());
    ::close(file);
  }
}

/** Creates an empty file that did not exist before, next to its final name, and locks it.
 *  \param permissions Of the file that it will replace, if there is one: what others may not read
 *  they may not read while it is written either.
 *  \return Its path, and the descriptor that has the lock. */
std::pair<std::string, int> createTemporary(
    const fs::path& finalPath, std::optional<mode_t> permissions)
{
  constexpr unsigned kAttempts = 100;
  for (unsigned attempt = 0; attempt < kAttempts; ++attempt)
  {
    const std::string path = temporaryFor(finalPath, attempt).string();
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0)
    {
      if (permissions) ::fchmod(file, *permissions | S_IWUSR);  // writers open it by its name
      if (lockNamed(file, path, true)) return {path, file};
      ::close(file);  // another program was faster, and removes it
    }
    else if (errno != EEXIST)
      failToWrite(finalPath.string(), errno);
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

/** Opening a pipe that nobody reads would wait without end. \return Its descriptor: while that is
 * open, the reader does not take the pipe to be at its end. */
int openPipe(const std::string& path)
{
  const int file = ::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0 && errno == ENXIO) throw std::runtime_error(path + ": nobody reads this pipe");
  if (file < 0) failToWrite(path, errno);
  return file;
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
  if (isDevice(target))
  {
    if (fs::is_fifo(target, ignored)) descriptor_ = openPipe(finalPath);
    return;
  }
  permissions_ = permissionsOf(target);
  const auto pause = Temporary::pause();
  removeLeftOver(target);
  std::tie(temporaryPath_, descriptor_) = createTemporary(target, permissions_);
  temporary_.emplace(temporaryPath_);
}

OutputFile::~OutputFile()
{
  temporary_.reset();
  if (descriptor_ >= 0) ::close(descriptor_);
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

void OutputFile::fail() const
{
  const int error = temporary_ ? errorOfWritingTo(temporaryPath_) : 0;  // no more into a device
  failToWrite(finalPath_, error != 0 ? error : EIO);
}

int errorOfWritingTo(const std::string& path)
{
  const std::vector<char> more(std::size_t{1} << 20);  // a disk that is nearly full takes less
  const int file = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return errno;
  ssize_t written = 1;
  for (std::size_t done = 0; written > 0 && done < more.size();
       done += static_cast<std::size_t>(written))
    written = ::write(file, more.data() + done, more.size() - done);
  const int error = written < 0 ? errno : 0;
  ::close(file);
  return error;
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
