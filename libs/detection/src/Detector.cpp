#include "quadmap/detection/Detector.h"

#include <filesystem>
#include <stdexcept>

#include "DnnDetector.h"
#include "model/ModelFolder.h"
#include "quadmap/detection/KnownDetectors.h"

namespace quadmap
{
namespace
{
/** The path of a file of a model. \exception std::runtime_error If it is missing. */
std::string requirePart(const std::string& modelFile, const std::string& name)
{
  if (const auto path = findModelPart(modelFile, name)) return *path;
  throw std::runtime_error(
      modelFile + ": its file " + name + " is neither beside it nor in " + detectorFolder() +
      " (quadmap-detect --list tells how to get it)");
}

std::string requireChecked(const std::string& modelFile, const ModelPart& part)
{
  const std::string path = requirePart(modelFile, part.file);
  if (const auto damage = damageOf(path, part, modelFile)) throw std::runtime_error(*damage);
  return path;
}

}  // namespace

std::unique_ptr<Detector> loadDetector(const std::string& model)
{
  const std::string file = modelFileOf(model);
  const DetectorModel options = DetectorModel::fromFile(file);
  ModelFiles files;
  files.name = std::filesystem::path(file).stem().string();
  if (options.isDarknet()) files.network = requireChecked(file, options.network);
  files.weights = requireChecked(file, options.weights);
  files.labels = requirePart(file, options.labels);
  return std::make_unique<DnnDetector>(options, files);
}

}  // namespace quadmap
