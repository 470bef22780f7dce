#include "quadmap/folders/ClassNames.h"

#include <mrpt/system/string_utils.h>

#include <stdexcept>

#include "quadmap/base/InputFile.h"

namespace quadmap
{
std::vector<std::string> readClassNames(const std::string& path)
{
  auto file = openModestText(path);
  std::vector<std::string> names;
  for (std::string line; std::getline(file, line);)
    if (std::string name = mrpt::system::trim(line); !name.empty())
      names.push_back(std::move(name));
  if (file.bad()) throw std::runtime_error(path + ": read error");
  return names;
}

}  // namespace quadmap
