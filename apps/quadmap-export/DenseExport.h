#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadmap/base/OutputGroup.h"
#include "quadmap/obs/ObjectList.h"

namespace quadmap
{
/** The clouds that were asked for. */
struct DenseExport
{
  std::optional<std::string> cloud;         //!< File for the cloud of the room
  std::optional<std::string> objectClouds;  //!< Folder for a cloud of each object
  std::optional<std::string> config;        //!< INI file with a section [dense]
};

/** Makes the clouds from the keyframes of a run, with a bar on a terminal.
 * \param result Folder of quadmap-slam. \param objects The objects of its map.
 * \param output The clouds appear when it is committed. \return What is to be said of them then.
 * \exception std::runtime_error For files that cannot be read or written, without points, and
 * without PCL. */
std::string writeDenseClouds(
    const std::string& result,
    const std::vector<ObjectRecord>& objects,
    const DenseExport& wanted,
    OutputGroup& output);

}  // namespace quadmap
