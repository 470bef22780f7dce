#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>
#include <vector>

#include "quadmap/points/PointTypes.h"

namespace quadmap
{
/** The region, in the robot's frame, that the sensor looks at. It is learnt from all measurements:
 * a place belongs to it when about as many measurements lie near it as near a usual measurement.
 * Measurements are counted in cells, so that long recordings stay quick. */
template <int D>
class LookedAtRegion
{
 public:
  LookedAtRegion() = default;
  /** \param measured All measurements, in the robot's frame [m]. */
  explicit LookedAtRegion(const std::vector<PointVector<D>>& measured);

  /** Number of measurements whose cells (0.1 m wide) are within 0.5 m of the position's cell. */
  std::size_t near(const PointVector<D>& position) const;
  std::size_t usual() const { return usual_; }  //!< Median of near() over all measurements
  bool contains(const PointVector<D>& position) const;

 private:
  using Cell = std::array<int, D>;
  struct Hash
  {
    std::size_t operator()(const Cell& cell) const;
  };
  static Cell cellOf(const PointVector<D>& position);

  std::unordered_map<Cell, std::size_t, Hash> near_;
  std::size_t usual_ = 0;
};

}  // namespace quadmap
