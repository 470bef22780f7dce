#include "quadmap/maps/MapFile.h"

#include <filesystem>
#include <stdexcept>

#include "quadmap/base/ErrorText.h"
#include "quadmap/sensors/SimpleMapReader.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

constexpr const char *kMapFile = "objects.quadmap", *kBoxFile = "objects.simplemap";

/** Calls `use` with all boxes of a simple map at the poses that stand with them. */
template <typename F>
void forEachFrame(const std::string& simpleMapPath, F&& use)
{
  bool hasBoxes = false;
  SimpleMapReader reader(simpleMapPath);
  while (const auto keyframe = reader.next())
  {
    mrpt::poses::CPose3D T_map_robot;
    keyframe->pose->getMean(T_map_robot);
    for (const auto& observation : *keyframe->observations)
      if (const auto* boxes = dynamic_cast<const CObservationObjects*>(observation.get()))
      {
        hasBoxes = true;
        try
        {
          use(*boxes, T_map_robot);
        }
        catch (const std::exception& e)
        {
          throw std::runtime_error(simpleMapPath + ": " + rootMessage(e));
        }
      }
  }
  if (!hasBoxes)
    throw std::runtime_error(
        simpleMapPath + ": has no boxes to make objects of, as objects.simplemap has");
}

CQuadricObjectMap mapAnew(const std::string& simpleMapPath)
{
  CQuadricObjectMap map;
  forEachFrame(
      simpleMapPath, [&](const CObservationObjects& boxes, const mrpt::poses::CPose3D& T_map_robot)
      { map.insertObservation(boxes, T_map_robot); });
  map.consolidate();
  map.conclude();
  return map;
}

}  // namespace

std::string mapFileOf(const std::string& path)
{
  if (!fs::exists(path)) throw std::runtime_error(path + ": there is no such file or folder");
  if (!fs::is_directory(path)) return path;
  const fs::path inFolder = fs::path(path) / kMapFile;
  if (!fs::exists(inFolder))
    throw std::runtime_error(inFolder.string() + ": is missing; is this a folder of quadmap-slam?");
  return inFolder.string();
}

CQuadricObjectMap readMap(const std::string& path)
{
  const std::string file = mapFileOf(path);
  const fs::path extension = fs::path(file).extension();
  if (extension == ".simplemap") return mapAnew(file);
  if (extension == ".json")
    throw std::runtime_error(
        file + ": is no object map but a list: give a .quadmap, the folder of a run, or a " +
        ".simplemap");
  CQuadricObjectMap map;
  map.loadFromFile(file);
  return map;
}

std::string framesFileOf(const std::string& path)
{
  fs::path file = mapFileOf(path);
  if (file.filename() == kMapFile) file.replace_filename(kBoxFile);
  return file.extension() == ".simplemap" && fs::exists(file) ? file.string() : std::string();
}

SessionFrames framesOf(const std::string& path)
{
  const std::string file = framesFileOf(path);
  if (file.empty()) return {};
  return [name = file](const auto& use) { forEachFrame(name, use); };
}

}  // namespace quadmap
