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
  // weakly_canonical() alone does not follow a link to what does not exist yet.
  const fs::path place = fs::weakly_canonical(withoutLink(fs::absolute(path)), error);
  require(path, error);
  const fs::path inFolder = place.lexically_relative(fs::canonical(folder, error));
  require(folder, error);
  return !inFolder.empty() && *inFolder.begin() != "..";
}

}  // namespace quadmap
