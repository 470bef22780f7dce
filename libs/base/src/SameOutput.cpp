#include "quadmap/base/SameOutput.h"

#include <sys/stat.h>

#include <filesystem>

#include "FileSystem.h"

namespace quadmap
{
namespace
{
bool isSamePipe(const std::string& one, const std::string& other)
{
  struct stat a, b;
  return ::stat(one.c_str(), &a) == 0 && ::stat(other.c_str(), &b) == 0 && S_ISFIFO(a.st_mode) &&
         a.st_dev == b.st_dev && a.st_ino == b.st_ino;
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

}  // namespace quadmap
