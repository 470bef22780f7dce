#include "quadmap/folders/ClassNames.h"

#include <mrpt/core/format.h>
#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <stdexcept>

#include "quadmap/base/InputFile.h"

namespace quadmap
{
void requireClassName(const std::string& name, const std::string& place)
{
  constexpr std::size_t kLongest = 200;  // [bytes]
  const auto isControl = [](unsigned char c) { return c < ' ' || c == 0x7f; };
  if (name.size() > kLongest)
    throw std::runtime_error(mrpt::format(
        "%s: the name of a class has %zu bytes, at most %zu can be used", place.c_str(),
        name.size(), kLongest));
  if (std::any_of(name.begin(), name.end(), isControl))
    throw std::runtime_error(place + ": the name of a class has control characters");
}

std::vector<std::string> readClassNames(const std::string& path)
{
  auto file = openModestText(path);
  std::vector<std::string> names;
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);)
  {
    ++number;
    std::string name = mrpt::system::trim(line);
    if (name.empty()) continue;
    requireClassName(name, path + ":" + std::to_string(number));
    names.push_back(std::move(name));
  }
  if (file.bad()) throw std::runtime_error(path + ": read error");
  return names;
}

}  // namespace quadmap
