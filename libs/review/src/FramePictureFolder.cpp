#include "quadmap/review/FramePictureFolder.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <filesystem>
#include <regex>

#include "quadmap/review/SceneRenderer.h"

namespace quadmap
{
namespace
{
bool isFramePicture(const std::filesystem::directory_entry& file)
{
  static const std::regex form("frame-[0-9]{6,}\\.jpg");
  return file.symlink_status().type() == std::filesystem::file_type::regular &&
         std::regex_match(file.path().filename().string(), form);
}
}  // namespace

FramePictureFolder::FramePictureFolder(const std::string& folder, OutputGroup* group) :
    group_(group), files_((group ? *group : own_).addFolder(folder, "frames"))
{
}

void FramePictureFolder::add(std::size_t frame, const mrpt::img::CImage& picture)
{
  writePicture(picture, files_.add(mrpt::format("frame-%06zu.jpg", frame)));
}

void FramePictureFolder::commit()
{
  auto names = files_.names();
  std::sort(names.begin(), names.end());
  for (const auto& file : std::filesystem::directory_iterator(files_.folder()))
  {
    const std::string name = file.path().filename().string();
    if (isFramePicture(file) && !std::binary_search(names.begin(), names.end(), name))
      files_.addRemoval(name);
  }
  if (!group_) own_.commit();
}

}  // namespace quadmap
