#include "quadmap/base/SameOutput.h"

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "FileSystem.h"

namespace quadmap
{
namespace
{
/** Whether the second one is there and is the first one. */
bool isSame(const struct stat& one, const std::string& other)
{
  struct stat s;
  return ::stat(other.c_str(), &s) == 0 && s.st_dev == one.st_dev && s.st_ino == one.st_ino;
}

bool isSamePipe(const std::string& one, const std::string& other)
{
  struct stat s;
  return ::stat(one.c_str(), &s) == 0 && S_ISFIFO(s.st_mode) && isSame(s, other);
}
}  // namespace

bool isSameOutput(const std::string& one, const std::string& other)
{
  if (isDevice(one) || isDevice(other)) return isSamePipe(one, other);
  std::error_code error, otherError;
  const auto place = placeOf(one, error), otherPlace = placeOf(other, otherError);
  if (error || otherError) return one == other;  // links in a circle, which cannot be written
  return place == otherPlace;
}

bool isStandardOutput(const std::string& path)
{
  struct stat printed;
  return ::fstat(STDOUT_FILENO, &printed) == 0 && isSame(printed, path) &&
         !isSame(printed, "/dev/null");
}

}  // namespace quadmap
