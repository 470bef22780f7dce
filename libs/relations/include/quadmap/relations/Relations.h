#pragma once

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/relations/Inventory.h"

namespace quadmap
{
/** How objects stand to each other: doc/mathematics.md, section 23. */
enum class RelationKind
{
  On,         //!< It stands on the other one
  In,         //!< At least half of it is inside the other one's cuboid
  Under,      //!< The other one is on it, or it is in one with a level top, as under a table
  NextTo,     //!< Beside it, with less of a gap than people would say "near" to
  Near,       //!< Within three times that gap
  InFrontOf,  //!< On the side that faces the middle of the map
  Behind,     //!< On the other side
  Between,    //!< Between two others
  Nearest,    //!< Of all that was asked for, it has the smallest gap
  Farthest    //!< Of all that was asked for, it has the largest gap
};

/** The words for a relation, as in "cup on table": "on", "next to". */
const char* textOf(RelationKind kind);

/** That `subject` is on, in, next to, in front of or behind `object`. Both are ids of objects. */
struct Relation
{
  RelationKind kind = RelationKind::On;
  std::string subject, object;
  /** On, in and next to: the gap between the two, (23.2). In front of and behind: how far the
   * centre of the subject is from that side of the object, (23.10) [m]. */
  double distance = 0;
};

/** All pairs of which one is directly on, in, next to, in front of or behind the other. Next to is
 * told once for each pair. Under and near follow from these or are weaker, and between is about
 * three objects: ask() knows them.
 * \return In the order of the subjects, then of the objects. */
std::vector<Relation> relationsOf(const Inventory& inventory);
std::vector<Relation> relationsOf(const CQuadricObjectMap& map);

/** Where the front of an object of the map looks: doc/mathematics.md, (23.9).
 * \return A unit vector along the floor, or nothing when nothing tells, as in the middle of the
 * map. \exception std::out_of_range If there is no such object. */
std::optional<Eigen::Vector2d> frontOf(const CQuadricObjectMap& map, ObjectId id);

/** The table, or another thing with a level top, that a chair of the map is drawn up to, and faces:
 * doc/mathematics.md, (23.9).
 * \return Nothing for other things. \exception std::out_of_range If there is no such object. */
std::optional<ObjectId> tableOf(const CQuadricObjectMap& map, ObjectId id);

}  // namespace quadmap
