#include "quadmap/base/InsideFolder.h"

#include "FileSystem.h"

namespace quadmap
{
namespace fs = std::filesystem;

bool isInside(const fs::path& path, const fs::path& folder)
{
  // weakly_canonical() alone does not follow a link to what does not exist yet.
  std::error_code noPath, noFolder;
  const fs::path place = fs::weakly_canonical(withoutLink(fs::absolute(path)), noPath);
  const fs::path inFolder = place.lexically_relative(fs::canonical(folder, noFolder));
  return !noPath && !noFolder && !inFolder.empty() && *inFolder.begin() != "..";
}

}  // namespace quadmap
