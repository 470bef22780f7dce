#include "quadmap/maps/MapFile.h"

#include <filesystem>
#include <stdexcept>

#include "quadmap/sensors/SimpleMapReader.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

CQuadricObjectMap mapAnew(const std::string& simpleMapPath)
{
  CQuadricObjectMap map;
  bool hasBoxes = false;
  SimpleMapReader reader(simpleMapPath);
  while (const auto keyframe = reader.next())
  {
    mrpt::poses::CPose3D T_map_robot;
    keyframe->pose->getMean(T_map_robot);
    for (const auto& observation : *keyframe->observations)
      if (dynamic_cast<const CObservationObjects*>(observation.get()))
      {
        hasBoxes = true;
        map.insertObservation(*observation, T_map_robot);
      }
  }
  if (!hasBoxes)
    throw std::runtime_error(
        simpleMapPath + ": has no boxes to make objects of, as objects.simplemap has");
  map.consolidate();
  return map;
}

}  // namespace

std::string mapFileOf(const std::string& path)
{
  if (!fs::exists(path)) throw std::runtime_error(path + ": there is no such file or folder");
  if (!fs::is_directory(path)) return path;
  const fs::path inFolder = fs::path(path) / "objects.quadmap";
  if (!fs::exists(inFolder))
    throw std::runtime_error(inFolder.string() + ": is missing; is this a folder of quadmap-slam?");
  return inFolder.string();
}

CQuadricObjectMap readMap(const std::string& path)
{
  const std::string file = mapFileOf(path);
  if (fs::path(file).extension() == ".simplemap") return mapAnew(file);
  CQuadricObjectMap map;
  map.loadFromFile(file);
  return map;
}

}  // namespace quadmap
