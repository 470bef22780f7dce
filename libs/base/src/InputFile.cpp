#include "quadmap/base/InputFile.h"

#include <mrpt/core/format.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "FileSystem.h"

namespace quadmap
{
void requireNoDevice(const std::string& path)
{
  if (isDevice(path)) throw std::runtime_error(path + ": is a pipe or a device, not a file");
}

std::ifstream openModestText(const std::string& path, std::uintmax_t mostBytes)
{
  requireNoDevice(path);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw std::runtime_error(path + ": is a directory, not a file");
  const auto size = std::filesystem::file_size(path, ignored);
  if (!ignored && size > mostBytes)
    throw std::runtime_error(mrpt::format(
        "%s: has %.1f MB, more than the %llu MB that such a file may have", path.c_str(),
        std::ldexp(static_cast<double>(size), -20),
        static_cast<unsigned long long>(mostBytes >> 20)));
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read: " + std::strerror(errno));
  return file;
}

std::string warningOfCut(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  file.seekg(-1, std::ios::end);
  const int last = file.get();
  if (last == std::ifstream::traits_type::eof() || last == '\n') return {};
  return "ends without a line break: its last line may be cut off";
}

}  // namespace quadmap
