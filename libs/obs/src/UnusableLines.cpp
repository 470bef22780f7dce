#include "quadmap/obs/UnusableLines.h"

#include <mrpt/core/format.h>

#include <stdexcept>

namespace quadmap
{
void noteUnusable(
    std::vector<std::string>& unusable, const std::string& file, const std::string& why)
{
  constexpr std::size_t kMost = 1000;  // each is kept in memory and told
  if (unusable.size() >= kMost)
    throw std::runtime_error(mrpt::format(
        "%s: more than %zu entries cannot be used, such as %s", file.c_str(), kMost,
        unusable.front().c_str()));
  unusable.push_back(why);
}

}  // namespace quadmap
