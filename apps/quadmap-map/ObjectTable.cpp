#include "ObjectTable.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "quadmap/base/ErrorText.h"
#include "quadmap/relations/Questions.h"

namespace quadmap
{
namespace
{
std::string yawText(const ObjectRecord& o)
{
  if (!o.orientationDefined) return "-";
  return mrpt::format("%.1f", mrpt::RAD2DEG(o.object.pose().yaw()));
}

std::string rowText(const ObjectRow& row)
{
  const ObjectRecord& o = *row.object;
  const Eigen::Vector3d c = o.object.center(), size = 2 * o.object.semiAxes();
  const std::string seen = o.observations ? std::to_string(*o.observations) : "-";
  const std::string existence = o.existence ? mrpt::format("%.2f", *o.existence) : "-";
  std::string text = mrpt::format(
      "%5s  %-16s %8.3f %8.3f %8.3f  %6.3f %6.3f %6.3f  %7s  %5s  %6s", oneLine(o.id).c_str(),
      oneLine(o.label).c_str(), c.x(), c.y(), c.z(), size.x(), size.y(), size.z(),
      yawText(o).c_str(), seen.c_str(), existence.c_str());
  if (row.distance) text += mrpt::format("  %8.3f", *row.distance);
  return text + "\n";
}

std::vector<const ObjectRecord*> confirmedIn(const Inventory& inventory)
{
  std::vector<const ObjectRecord*> confirmed;
  for (const InventoryItem& item : inventory.items)
    if (item.confirmed) confirmed.push_back(&item.record);
  return confirmed;
}

std::string labelCounts(const Inventory& inventory)
{
  std::map<std::string, int> counts;
  for (const ObjectRecord* object : confirmedIn(inventory)) ++counts[object->label];
  std::string text;
  for (const auto& [label, count] : counts)
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + oneLine(label);
  return text;
}

std::string extentText(const std::vector<const ObjectRecord*>& objects)
{
  Eigen::AlignedBox3d extent;
  for (const ObjectRecord* object : objects)
  {
    const Eigen::Matrix<double, 3, 8> corners = object->object.cuboidCorners();
    for (Eigen::Index i = 0; i < corners.cols(); ++i) extent.extend(corners.col(i));
  }
  const Eigen::Vector3d a = extent.min(), b = extent.max();
  return mrpt::format(
      "extent: x %.2f ... %.2f, y %.2f ... %.2f, z %.2f ... %.2f m\n", a.x(), b.x(), a.y(), b.y(),
      a.z(), b.z());
}

}  // namespace

std::string footprintText(const Ellipsoid& object)
{
  const Eigen::Matrix<double, 3, 8> corners = object.cuboidCorners();
  std::string text = "       footprint [m]:";
  for (const Eigen::Index corner : {0, 1, 3, 2})  // counter-clockwise from above
    text += mrpt::format(" (%.3f, %.3f)", corners(0, corner), corners(1, corner));
  return text + "\n";
}

std::string objectTable(const std::vector<ObjectRow>& rows, bool withFootprints)
{
  if (rows.empty()) return "no objects\n";
  std::string text = mrpt::format(
      "%5s  %-16s %26s  %20s  %7s  %5s  %6s", "id", "label", "centre [m]", "size [m]", "yaw[deg]",
      "seen", "exists");
  if (rows.front().distance) text += mrpt::format("  %8s", "away [m]");
  text += "\n";
  for (const ObjectRow& row : rows)
  {
    text += rowText(row);
    if (withFootprints) text += footprintText(row.object->object);
  }
  return text;
}

std::string mapSummary(const Inventory& inventory, const std::string& path, const std::string& seen)
{
  const auto confirmed = confirmedIn(inventory);
  std::string text = path + ": object map, " + std::to_string(confirmed.size()) + " objects";
  const std::size_t others = inventory.items.size() - confirmed.size();
  if (others > 0) text += mrpt::format(" (and %zu without enough evidence)", others);
  text += "\n";
  if (confirmed.empty()) return text;
  text += "labels: " + labelCounts(inventory) + "\n" + extentText(confirmed) + seen + "\n";
  std::vector<ObjectRow> rows;
  for (const ObjectRecord* object : confirmed) rows.push_back({object, std::nullopt});
  return text + objectTable(rows, false);
}

void requireLabel(const Inventory& inventory, const std::string& label, const std::string& path)
{
  const std::string canonical = inventory.labels.canonical(label);
  const auto hasIt = [&](const InventoryItem& item)
  { return inventory.labels.canonical(item.record.label) == canonical; };
  if (inventory.labels.properties(label).known ||
      std::any_of(inventory.items.begin(), inventory.items.end(), hasIt))
    return;
  std::string similar;
  for (const std::string& word : similarLabels(inventory, label))
    similar += (similar.empty() ? "; did you mean \"" : "\" or \"") + oneLine(word);
  throw std::runtime_error(
      path + ": \"" + oneLine(label) + "\" is a label neither of the map's label table nor of " +
      "its objects (" + labelCounts(inventory) + ")" + similar + (similar.empty() ? "" : "\"?"));
}

}  // namespace quadmap
