#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "Geometry.h"
#include "quadmap/relations/Relations.h"

namespace quadmap
{
/** What things are on and in, directly or by way of others. */
class Carriers
{
 public:
  /** Looks at all pairs of things. \param geometry Must outlive this. */
  explicit Carriers(const Geometry& geometry);

  /** What carries the subject on the way to the object, which is the last and carries it as `kind`
   * says, On or In; nothing when it does not. The way is the shortest. */
  std::optional<std::vector<std::size_t>> way(
      std::size_t subject, std::size_t object, RelationKind kind) const;

 private:
  const Geometry& geometry_;
  std::vector<std::vector<std::size_t>> carriersOf_;  // of each thing what it is directly on or in
};

}  // namespace quadmap
