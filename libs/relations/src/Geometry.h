#pragma once

#include <optional>
#include <vector>

#include "Footprint.h"
#include "quadmap/relations/Relations.h"

namespace quadmap
{
/** The relations of an inventory's objects as geometry says them: doc/mathematics.md, section 23.
 * Objects are named by their index in the inventory, which has to outlive this. Each relation is
 * empty when it does not hold, else a distance [m]. */
class Geometry
{
 public:
  explicit Geometry(const Inventory& inventory);

  std::size_t size() const { return solids_.size(); }

  /** Between the cuboids of two objects, (23.2) [m]. */
  double gap(std::size_t i, std::size_t j) const;

  std::optional<double> on(std::size_t i, std::size_t j) const;      //!< Directly; the gap
  std::optional<double> in(std::size_t i, std::size_t j) const;      //!< Directly; the gap
  std::optional<double> nextTo(std::size_t i, std::size_t j) const;  //!< The gap
  std::optional<double> near(std::size_t i, std::size_t j) const;    //!< The gap
  /** How far i is before the front of j. */
  std::optional<double> inFrontOf(std::size_t i, std::size_t j) const;
  std::optional<double> behind(std::size_t i, std::size_t j) const;
  /** How much longer the way from j to k is by i, (23.11). */
  std::optional<double> between(std::size_t i, std::size_t j, std::size_t k) const;

  /** The direction out of the front of an object, (23.9); zero when nothing tells. */
  Eigen::Vector2d frontOf(std::size_t i) const { return solids_[i].front; }

  /** The table that a chair is drawn up to, and faces. */
  std::optional<std::size_t> tableOf(std::size_t i) const { return solids_[i].table; }

  bool hasLevelTop(std::size_t i) const { return solids_[i].hasLevelTop; }

 private:
  /** An object as an upright prism on its footprint. */
  struct Solid
  {
    Ellipsoid object;
    Footprint footprint;
    double area = 0;             // of the footprint [m^2]
    double bottom = 0, top = 0;  // z in the map [m]
    double lowestSeat = 0;       // lowest height at which things stand on it [m]
    double seatTolerance = 0;    // [m]
    bool hasLevelTop = false, isDirected = false, isChair = false, isDoubtful = false;
    std::optional<std::size_t> table;                 // that it is drawn up to
    Eigen::Vector2d front = Eigen::Vector2d::Zero();  // direction out of it
  };

  static Solid solidOf(const InventoryItem& item, const LabelTable& labels);
  double gap(const Solid& a, const Solid& b) const;
  double nextToBound(const Solid& a, const Solid& b) const;
  std::optional<std::size_t> tableFor(const Solid& chair) const;
  Eigen::Vector2d frontTowards(const Solid& solid, const Eigen::Vector2d& faced) const;
  std::optional<double> onSide(const Solid& subject, const Solid& object, double sign) const;

  std::vector<Solid> solids_;
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero();  // of the map [m]
};

}  // namespace quadmap
