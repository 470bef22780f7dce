#include "quadmap/base/InsideFolder.h"

#include <stdexcept>
#include <system_error>

#include "FileSystem.h"

namespace quadmap
{
namespace fs = std::filesystem;

namespace
{
/** \exception std::runtime_error With the path and what the system says. */
void require(const fs::path& path, const std::error_code& error)
{
  if (error) throw std::runtime_error(path.string() + ": " + error.message());
}
}  // namespace

bool isInside(const fs::path& path, const fs::path& folder)
{
  std::error_code error;
  const fs::path place = placeOf(path, error);
  require(path, error);
  const fs::path inFolder = place.lexically_relative(fs::canonical(folder, error));
  require(folder, error);
  return !inFolder.empty() && *inFolder.begin() != "..";
}

}  // namespace quadmap
