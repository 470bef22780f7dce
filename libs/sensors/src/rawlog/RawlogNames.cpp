#include "quadmap/sensors/RawlogNames.h"

#include <filesystem>

namespace quadmap
{
namespace
{
/** Cuts off an ending. \return False when the name does not have it. */
bool cut(std::string& name, const std::string& ending)
{
  const bool has = name.size() > ending.size() &&
                   name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
  if (has) name.resize(name.size() - ending.size());
  return has;
}
/** The path without .rawlog or .rawlog.gz. */
std::string stemOf(std::string name)
{
  cut(name, ".gz");
  cut(name, ".rawlog");
  return name;
}
}  // namespace

std::string objectsFileOf(const std::string& rawlog)
{
  const bool gz = rawlog.size() > 3 && rawlog.compare(rawlog.size() - 3, 3, ".gz") == 0;
  return stemOf(rawlog) + ".objects.rawlog" + (gz ? ".gz" : "");
}

std::string imagesFolderOf(const std::string& rawlog) { return stemOf(rawlog) + "_Images"; }

std::string findImagesFolder(const std::string& rawlog)
{
  namespace fs = std::filesystem;
  const fs::path beside = fs::absolute(rawlog).parent_path();
  const std::string stem = stemOf(fs::absolute(rawlog).string());
  for (const std::string& folder :
       {stem + "_Images", stem + "_images", stem + "_IMAGES", (beside / "Images").string()})
    if (fs::is_directory(folder)) return folder;
  return beside.string();
}

}  // namespace quadmap
