#include "quadmap/folders/FolderCamera.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <utility>

#include "frames/CameraPreset.h"
#include "frames/ResizedCamera.h"
#include "quadmap/base/ShareFiles.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* kExtension = ".ini";

fs::path presetFolder() { return fs::path(findShareFile("cameras/fr1.ini")).parent_path(); }

/** The words of letters and digits in a name, in lower case. */
std::set<std::string> wordsOf(const std::string& name)
{
  std::set<std::string> words;
  std::string word;
  for (const char c : name + " ")
    if (std::isalnum(static_cast<unsigned char>(c)))
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!word.empty())
      words.insert(std::exchange(word, {}));
  return words;
}
}  // namespace

std::vector<std::string> cameraPresetNames()
{
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(presetFolder()))
    if (entry.path().extension() == kExtension) names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

FolderCamera cameraPreset(const std::string& what)
{
  if (fs::path(what).extension() == kExtension)
  {
    FolderCamera camera = CameraPreset::fromFile(what).camera(what);
    camera.file = what;
    return camera;
  }
  std::string known;
  for (const auto& name : cameraPresetNames())
  {
    if (name == what)
      return CameraPreset::fromFile((presetFolder() / (name + kExtension)).string())
          .camera("camera " + name);
    known += (known.empty() ? "" : ", ") + name;
  }
  throw std::runtime_error(what + ": no such camera; known are " + known + ", and files *.ini");
}

std::optional<std::string> presetOfFolder(const std::string& folder)
{
  std::error_code ignored;
  fs::path path = fs::weakly_canonical(folder, ignored);
  if (!path.has_filename()) path = path.parent_path();
  for (const fs::path& level : {path, path.parent_path()})
  {
    const auto words = wordsOf(level.filename().string());
    for (const auto& name : cameraPresetNames())
      for (const auto& word :
           CameraPreset::fromFile((presetFolder() / (name + kExtension)).string()).folderWords())
        if (words.count(word) > 0) return name;
  }
  return std::nullopt;
}

mrpt::img::TCamera scaledTo(const FolderCamera& camera, unsigned width, unsigned height)
{
  const auto& own = camera.color;
  if (std::uint64_t{width} * own.nrows != std::uint64_t{height} * own.ncols)
    throw std::runtime_error(mrpt::format(
        "%s is for %ux%u, the images are %ux%u", camera.origin.c_str(), own.ncols, own.nrows, width,
        height));
  return resized(own, width, height);
}

}  // namespace quadmap
