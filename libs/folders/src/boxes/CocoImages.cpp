#include "boxes/CocoImages.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <tuple>

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

/** How well the folders of an image of the file agree with those of a recording. */
struct Agreement
{
  std::size_t folders = 0;  // that the paths have in common at their ends
  bool isWhole = false;     // whether these are all folders of the image of the file

  bool operator<(const Agreement& other) const
  {
    return std::tie(folders, isWhole) < std::tie(other.folders, other.isWhole);
  }
};

Agreement agreementOf(const fs::path& place, const fs::path& recording)
{
  const std::vector<fs::path> a(place.begin(), place.end()), b(recording.begin(), recording.end());
  const auto differing = std::mismatch(a.rbegin(), a.rend(), b.rbegin(), b.rend()).first;
  return {static_cast<std::size_t>(differing - a.rbegin()), differing == a.rend()};
}
}  // namespace

CocoImages::Image& CocoImages::of(const std::string& image)
{
  meant_.clear();
  const fs::path path = fs::path(image).lexically_normal();
  Image& found = images_[withoutExtension(path)][path.parent_path().string()];
  if (found.written.empty()) found.written = image;
  return found;
}

CocoImages::Meant CocoImages::imagesMeantIn(const std::string& folder) const
{
  std::map<std::string, Agreement> agreements;  // by folders that the file names
  for (const auto& [name, places] : images_)
    for (const auto& [place, image] : places)
      if (agreements.count(place) == 0) agreements[place] = agreementOf(place, folder);
  using Places = std::map<std::string, Image>;
  const auto bestOf = [&](const Places& places, const std::set<std::string>& without)
  {
    Agreement best;
    for (const auto& [place, image] : places)
      if (without.count(place) == 0) best = std::max(best, agreements.at(place));
    return best;
  };
  std::set<std::string> others;  // folders of other recordings or cameras
  for (const auto& [name, places] : images_)
  {
    const Agreement best = bestOf(places, {});
    for (const auto& [place, image] : places)
      if (const auto& own = agreements.at(place); !own.isWhole && own < best) others.insert(place);
  }
  Meant meant;
  for (const auto& [name, places] : images_)
  {
    const Agreement best = bestOf(places, others);
    for (const auto& [place, image] : places)
      if (others.count(place) == 0 && !(agreements.at(place) < best)) meant[name].push_back(&image);
  }
  return meant;
}

std::vector<const CocoImages::Image*> CocoImages::candidates(
    const std::string& path, const std::vector<std::string>& names) const
{
  const std::string folder = fs::absolute(path).lexically_normal().parent_path().string();
  if (meant_.count(folder) == 0) meant_[folder] = imagesMeantIn(folder);
  const Meant& meant = meant_.at(folder);
  for (const auto& name : names)
    if (const auto found = meant.find(name); found != meant.end()) return found->second;
  return {};
}

const CocoImages::Image* CocoImages::find(
    const std::string& path, const std::vector<std::string>& names) const
{
  const auto found = candidates(path, names);
  if (found.size() > 1)
    throw std::runtime_error(
        file_ + ": image " + found[0]->written + " and image " + found[1]->written +
        " may both be " + path + "; name them with folders that end as those of the recording");
  return found.empty() ? nullptr : found[0];
}

}  // namespace quadmap
