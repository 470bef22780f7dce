#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "quadmap/dense/ObjectPoints.h"
#include "quadmap/obs/LabelTable.h"

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
  /** Whether other things are so near to the sides +x, -x, +y, -y that points may be theirs. */
  std::array<bool, 4> touched{};

  /** All five are seen and none is touched: the cuboid needs no guess about an end. */
  bool fullySeen() const;
};

/** Fits a cuboid to the points of an object: the bottom is where it stands, the sides are the
 * rectangle of least area around the plan, the top is where its points end or, below things that
 * lie on the object, its level surface: doc/mathematics.md, (22.2) and (22.3). No side is shorter
 * than 2 mm. \return Nothing when there are too few points. */
std::optional<CuboidProposal> proposeCuboid(const ObjectPoints& object, const LabelTable& labels);

}  // namespace quadmap
