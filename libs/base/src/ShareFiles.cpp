#include "quadmap/base/ShareFiles.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

/** The folder of the file this code was loaded from: the library, or the program when linked in. */
fs::path libraryFolder()
{
  Dl_info info;
  if (dladdr(reinterpret_cast<const void*>(&findShareFile), &info) == 0 || !info.dli_fname)
    return {};
  std::error_code failed;
  const fs::path file = fs::canonical(info.dli_fname, failed);
  return failed ? fs::path() : file.parent_path();
}

/** In order of preference. */
std::vector<fs::path> shareFolders()
{
  std::vector<fs::path> folders;
  const char* fromUser = std::getenv("QUADMAP_SHARE_DIR");
  if (fromUser && *fromUser) folders.emplace_back(fromUser);
  if (const fs::path lib = libraryFolder(); !lib.empty())
  {
    folders.push_back((lib / "../share/quadmap").lexically_normal());     // PREFIX/lib
    folders.push_back((lib / "../../share/quadmap").lexically_normal());  // PREFIX/lib/<machine>
  }
  folders.emplace_back(QUADMAP_SOURCE_SHARE_DIR);
  return folders;
}

}  // namespace

std::string findShareFile(const std::string& name)
{
  std::string tried;
  for (const auto& folder : shareFolders())
  {
    std::error_code ignored;
    const fs::path candidate = folder / name;
    if (fs::is_regular_file(candidate, ignored)) return candidate.string();
    tried += (tried.empty() ? "" : ", ") + folder.string();
  }
  throw std::runtime_error(
      "data file \"" + name + "\" not found in " + tried + " (set QUADMAP_SHARE_DIR)");
}

}  // namespace quadmap
