#include "boxes/CocoImages.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

/** The name of an image's file without folder and extension. Names that are times have a point
 * where no extension begins. */
std::string withoutExtension(const fs::path& file)
{
  const fs::path name = file.filename();
  std::string extension = name.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* known : {".png", ".jpg", ".jpeg", ".pcd"})
    if (extension == known) return name.stem().string();
  return name.string();
}

/** The number of folders that two paths have in common at their ends. */
std::size_t commonFolders(const fs::path& a, const fs::path& b)
{
  const std::vector<fs::path> foldersOfA(a.begin(), a.end()), foldersOfB(b.begin(), b.end());
  const auto differing =
      std::mismatch(foldersOfA.rbegin(), foldersOfA.rend(), foldersOfB.rbegin(), foldersOfB.rend());
  return static_cast<std::size_t>(differing.first - foldersOfA.rbegin());
}
}  // namespace

CocoImages::Boxes& CocoImages::of(const std::string& image)
{
  const fs::path path = fs::path(image).lexically_normal();
  return folders_[path.parent_path().string()][withoutExtension(path)];
}

std::vector<CocoImages::Image> CocoImages::candidates(
    const std::string& path, const std::vector<std::string>& names) const
{
  const fs::path folder = fs::absolute(path).lexically_normal().parent_path();
  std::size_t nearest = 0;
  for (const auto& [place, images] : folders_)
    nearest = std::max(nearest, commonFolders(place, folder));
  const auto isNear = [&](const std::string& place)  // a name without folders may be of any
  { return place.empty() || commonFolders(place, folder) == nearest; };
  for (const auto& name : names)
  {
    std::vector<Image> found;
    for (const auto& [place, images] : folders_)
      if (const auto image = images.find(name); image != images.end() && isNear(place))
        found.emplace_back((fs::path(place) / name).string(), &image->second);
    if (!found.empty()) return found;
  }
  return {};
}

const CocoImages::Boxes* CocoImages::find(
    const std::string& path, const std::vector<std::string>& names) const
{
  const auto found = candidates(path, names);
  if (found.size() > 1)
    throw std::runtime_error(
        file_ + ": image " + found[0].first + " and image " + found[1].first + " may both be " +
        path);
  return found.empty() ? nullptr : found[0].second;
}

}  // namespace quadmap
