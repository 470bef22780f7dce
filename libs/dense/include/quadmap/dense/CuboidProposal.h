#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "quadmap/dense/ObjectPoints.h"

namespace quadmap
{
/** The tight upright cuboid around the points of an object: a proposal for the truth, which owes
 * nothing to the size that the map gives the object. */
struct CuboidProposal
{
  ObjectRecord record;     //!< Id and label are those of the map, the cuboid is the points'
  std::size_t points = 0;  //!< Number of points behind it
  /** Whether cameras saw the sides +x, -x, +y, -y and +z of the cuboid along their whole length. */
  std::array<bool, 5> seen{};

  bool fullySeen() const;  //!< All five: the cuboid needs no guess about a hidden end
};

/** Fits a cuboid to the points of an object: the bottom is where it stands, the sides are the
 * rectangle of least area around the plan, the top is where its points end: doc/mathematics.md,
 * (22.2) and (22.3). No side is shorter than 2 mm.
 * \return Nothing when there are too few points. */
std::optional<CuboidProposal> proposeCuboid(const ObjectPoints& object);

}  // namespace quadmap
