#include "model/ModelFolder.h"

#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "quadmap/base/Sha256.h"
#include "quadmap/base/ShareFiles.h"
#include "quadmap/detection/KnownDetectors.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* kExtension = ".ini";

/** The value of a variable, empty when it is not set. */
std::string variable(const char* name)
{
  const char* value = std::getenv(name);
  return value ? value : "";
}

/** The folder of the project's model files. */
fs::path sharedFolder() { return fs::path(findShareFile("detectors/coco.names")).parent_path(); }

std::vector<std::string> modelFilesIn(const fs::path& folder)
{
  std::vector<std::string> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == kExtension) files.push_back(entry.path().string());
  const auto stem = [](const std::string& file) { return fs::path(file).stem(); };
  std::sort(
      files.begin(), files.end(),
      [&](const std::string& a, const std::string& b) { return stem(a) < stem(b); });
  return files;
}

bool isFile(const fs::path& path)
{
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/** Whether a file is named as a network or a part of one, and not as a model file. */
bool isNetwork(const fs::path& path)
{
  const std::string extension = mrpt::system::lowerCase(path.extension().string());
  return extension == ".onnx" || extension == ".weights" || extension == ".cfg";
}

/** Why a network cannot be used where a model file is expected. */
std::string whyNoModelFile(const fs::path& network)
{
  if (!isFile(network)) return network.string() + ": there is no such file";
  const fs::path beside = fs::path(network).replace_extension(kExtension);
  if (isFile(beside))
    return network.string() + ": is a network and needs a model file; " + beside.string() +
           " is beside it";
  return network.string() +
         ": is a network and needs a model file (.ini) with weights, labels, width and height; "
         "see quadmap-detect --help";
}

}  // namespace

std::string detectorFolder()
{
  if (const std::string folder = variable("QUADMAP_MODELS"); !folder.empty()) return folder;
  const std::string data = variable("XDG_DATA_HOME");
  const fs::path home = data.empty() ? fs::path(variable("HOME")) / ".local/share" : fs::path(data);
  return (home / "quadmap/detectors").string();
}

std::string modelFileOf(const std::string& model)
{
  const fs::path path(model);
  if (path.extension() == kExtension)
  {
    if (!isFile(path)) throw std::runtime_error(model + ": there is no such model file");
    return model;
  }
  if (isNetwork(path)) throw std::runtime_error(whyNoModelFile(path));
  std::string known;
  for (const std::string& file : allModelFiles())
  {
    const std::string name = fs::path(file).stem().string();
    if (name == model) return file;
    known += (known.empty() ? "" : ", ") + name;
  }
  throw std::runtime_error(model + ": is no known model and no model file (.ini); known: " + known);
}

std::vector<std::string> allModelFiles()
{
  std::vector<std::string> files = modelFilesIn(sharedFolder());
  for (auto& own : modelFilesIn(detectorFolder())) files.push_back(std::move(own));
  return files;
}

std::optional<std::string> findModelPart(const std::string& modelFile, const std::string& name)
{
  for (const fs::path& folder :
       {fs::path(modelFile).parent_path(), fs::path(detectorFolder()), sharedFolder()})
    if (const fs::path path = folder / name; isFile(path)) return path.string();
  return std::nullopt;
}

std::optional<std::string> damageOf(
    const std::string& path, const ModelPart& part, const std::string& modelFile)
{
  if (part.sha256.empty()) return std::nullopt;
  const std::string sum = sha256OfFile(path);
  if (sum == part.sha256) return std::nullopt;
  return path + ": is damaged or another file: its SHA-256 is " + sum + ", that in " + modelFile +
         " is " + part.sha256;
}

}  // namespace quadmap
