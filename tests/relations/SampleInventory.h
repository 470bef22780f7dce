#pragma once

#include <string>

#include "quadmap/relations/Inventory.h"

namespace quadmap::testing
{
/** A certain object of a map. \param size Full sizes [m]. */
inline InventoryItem item(
    const std::string& id,
    const std::string& label,
    const Eigen::Vector3d& center,
    const Eigen::Vector3d& size,
    double yaw = 0)
{
  InventoryItem item;
  item.record.id = id;
  item.record.label = label;
  item.record.object =
      Ellipsoid(mrpt::poses::CPose3D(center.x(), center.y(), center.z(), yaw, 0, 0), 0.5 * size);
  item.record.existence = 0.99;
  return item;
}

/** The same one on a height. \param bottom z of its lower face [m]. */
inline InventoryItem standing(
    const std::string& id,
    const std::string& label,
    const Eigen::Vector2d& at,
    double bottom,
    const Eigen::Vector3d& size,
    double yaw = 0)
{
  return item(id, label, {at.x(), at.y(), bottom + 0.5 * size.z()}, size, yaw);
}

inline Inventory inventoryWith(std::vector<InventoryItem> items)
{
  Inventory inventory;
  inventory.labels = LabelTable::installed();
  inventory.items = std::move(items);
  return inventory;
}

/** A living room, x to the right and y away from the sofa, with the tv on its cabinet at y = 2. */
inline Inventory livingRoom()
{
  return inventoryWith({
      standing("1", "tv", {0.0, 2.0}, 0.50, {1.00, 0.10, 0.60}),
      standing("2", "cabinet", {0.0, 2.0}, 0.00, {1.40, 0.40, 0.50}),
      standing("3", "coffee table", {0.0, 0.5}, 0.00, {1.00, 0.60, 0.45}),
      standing("4", "couch", {0.0, -1.0}, 0.00, {2.00, 0.90, 0.80}),
      standing("5", "cup", {0.3, 0.6}, 0.47, {0.08, 0.08, 0.10}),
      standing("6", "bowl", {-0.2, 0.5}, 0.45, {0.25, 0.25, 0.10}),
      standing("7", "apple", {-0.2, 0.5}, 0.46, {0.07, 0.07, 0.07}),
      standing("8", "cup", {0.9, 2.9}, 0.00, {0.08, 0.08, 0.10}),
      standing("9", "teddy bear", {0.5, -1.0}, 0.42, {0.20, 0.20, 0.30}),
      standing("10", "suitcase", {0.2, 0.5}, 0.00, {0.40, 0.30, 0.30}),
      standing("11", "potted plant", {1.2, 2.0}, 0.00, {0.40, 0.40, 0.90}),
  });
}

}  // namespace quadmap::testing
