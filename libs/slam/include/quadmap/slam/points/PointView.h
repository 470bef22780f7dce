#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>
#include <vector>

#include "quadmap/slam/points/PointTypes.h"

namespace quadmap
{
/** Where a sensor looks, as everything it measured shows it: about as many measurements lie near a
 * place it looks at as usual. Counted in cells, so that long recordings stay quick. */
template <int D>
class PointView
{
 public:
  PointView() = default;
  /** \param measured All measurements, in the robot's frame [m]. */
  explicit PointView(const std::vector<PointVector<D>>& measured);

  /** Measurements within 0.5 m of the cell (0.1 m wide) of a position, by their cells. */
  std::size_t near(const PointVector<D>& position) const;
  std::size_t usual() const { return usual_; }  //!< near() a measurement: the median
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
