#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace quadmap
{
/** How well one object of a map explains the depth images it was made of: doc/mathematics.md,
 * (22.4) and (22.5). */
struct SelfCheckedObject
{
  std::string id, label;
  std::size_t points = 0;  //!< Number of its points, as the images and its boxes tell them
  /** Shares of these points that lie on its cuboid's surface, inside, and beyond; empty without
   * points. */
  std::optional<double> onSurface, inside, beyond;
  std::size_t rays = 0;  //!< Number of pixels that look into it and see it or what is behind it
  std::optional<double> through;  //!< Share of these that go through it; empty without rays
};

struct SelfCheck
{
  std::vector<SelfCheckedObject> objects;  //!< In the order of the map

  /** Means over the objects that have the figure; empty when none has. */
  std::optional<double> meanOnSurface() const, meanInside() const, meanBeyond() const,
      meanThrough() const;
};

}  // namespace quadmap
