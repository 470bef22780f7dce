#include "quadmap/detection/KnownDetectors.h"

#include <exception>
#include <filesystem>

#include "model/DetectorModel.h"
#include "model/ModelFolder.h"
#include "quadmap/base/ErrorText.h"

namespace quadmap
{
namespace
{
/** A word of a shell. */
std::string quoted(const std::string& text)
{
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/** A command that gets the parts that are missing. */
std::string commandFor(const std::vector<ModelPart>& missing)
{
  std::string command = "mkdir -p " + quoted(detectorFolder());
  for (const ModelPart& part : missing)
  {
    const std::string path = (std::filesystem::path(detectorFolder()) / part.file).string();
    if (part.url.empty())
      return "no source is named for its licence: put your own " + part.file + " into " +
             detectorFolder();
    command += " && curl -fL -o " + quoted(path) + " " + quoted(part.url);
    if (!part.sha256.empty())
      command += " && echo " + quoted(part.sha256 + "  " + path) + " | sha256sum -c";
  }
  return command;
}

KnownDetector knownFrom(const std::string& file)
{
  KnownDetector known;
  known.name = std::filesystem::path(file).stem().string();
  try
  {
    const DetectorModel model = DetectorModel::fromFile(file);
    known.licence = model.licence;
    std::vector<ModelPart> missing;
    for (const ModelPart& part : model.parts())
    {
      const auto path = findModelPart(file, part.file);
      const auto damage = path ? damageOf(*path, part, file) : std::nullopt;
      if (damage) known.problem = *damage;
      if (!path || damage) missing.push_back(part);
    }
    known.installed = missing.empty();
    if (!known.installed) known.howToGet = commandFor(missing);
  }
  catch (const std::exception& e)
  {
    known.problem = rootMessage(e);
  }
  return known;
}

}  // namespace

std::vector<KnownDetector> knownDetectors()
{
  std::vector<KnownDetector> known;
  for (const std::string& file : allModelFiles()) known.push_back(knownFrom(file));
  return known;
}

}  // namespace quadmap
