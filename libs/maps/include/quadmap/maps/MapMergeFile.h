#pragma once

#include <string>

#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/maps/MapMerge.h"

namespace quadmap
{
/** One of the two maps of a merge, as the report names it. */
struct MergeInput
{
  std::string file;        //!< Of the map
  std::string sha256;      //!< Of the file, as hexadecimal digits
  bool hasFrames = false;  //!< It was known what its frames showed
};

/** What a merge did, in the form quadmap-merge of doc/formats.md.
 * \param merged The map that mergeMap() was called for, afterwards. */
std::string mergeToJson(
    const MapMerge& merge,
    const MergeInput& own,
    const MergeInput& other,
    const CQuadricObjectMap& merged);

/** The options of section [merging] of an INI file.
 * \exception std::runtime_error If the file cannot be read.
 * \exception std::invalid_argument Without the section, for unknown keys and bad values; the
 * message starts with the file's name. */
MapMergeOptions readMergeOptions(const std::string& path);

}  // namespace quadmap
