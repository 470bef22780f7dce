#pragma once

#include <string>
#include <vector>

#include "quadmap/maps/CQuadricObjectMap.h"

namespace quadmap
{
/** One change of a map that a person made by hand (doc/formats.md, edits). */
struct MapEdit
{
  enum class Kind
  {
    Relabel,
    Merge,
    Remove,
    Place
  };
  Kind kind = Kind::Remove;
  ObjectId id = 0;        //!< The object; of a merge the one that stays
  ObjectId absorbed = 0;  //!< Merge: the one that goes into it
  std::string label;      //!< Relabel: the new one
  Ellipsoid object;       //!< Place: where it is, and how large
};

/** An edit list as a page saves it. */
struct MapEditList
{
  /** Checksum of the file of the map that it was made for, as hexadecimal digits, or empty. */
  std::string mapSha256;
  std::vector<MapEdit> edits;  //!< In their order
};

/** \exception std::runtime_error For a file that cannot be read or is no edit list. The message
 * names file and edit. */
MapEditList readMapEdits(const std::string& path);

/** Applies the edits in their order.
 * \exception std::runtime_error If an object is not there, or cannot be edited so. The message
 * names the edit. The map then is as it was. */
void applyEdits(const std::vector<MapEdit>& edits, CQuadricObjectMap& map);

}  // namespace quadmap
