#pragma once

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/serialization/CArchive.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/obs/GzipStream.h"

namespace quadmap
{
/** Reads objects.quadmap. \exception std::runtime_error One line that names the file. */
inline CQuadricObjectMap::Ptr readMapFile(const std::string& path)
{
  registerMapClasses();
  mrpt::io::CFileGZInputStream file;
  if (!std::filesystem::is_regular_file(path) || !file.open(path))
    throw std::runtime_error(path + ": cannot be read");
  mrpt::serialization::CSerializable::Ptr object;
  try
  {
    object = mrpt::serialization::archiveFrom(file).ReadObject();
  }
  catch (const std::exception&)  // its text speaks of the archive's insides
  {
    throw std::runtime_error(
        path + ": is no object map, or it is truncated, damaged or of a newer version");
  }
  auto map = std::dynamic_pointer_cast<CQuadricObjectMap>(object);
  if (!map)
    throw std::runtime_error(
        path + ": holds " + (object ? object->GetRuntimeClass()->className : "nothing") +
        ", not an object map (CQuadricObjectMap)");
  return map;
}

/** Writes a map, complete or not at all. \exception std::runtime_error Names the file. */
inline void writeMapFile(const std::string& path, const CQuadricObjectMap& map)
{
  writeArchive(path, map);
}

}  // namespace quadmap
