#include "ObjectTable.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>
#include <mrpt/system/datetime.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace quadmap
{
namespace
{
std::string yawText(const MapObject& o)
{
  if (!o.orientationDefined) return "-";
  return mrpt::format("%.1f", mrpt::RAD2DEG(o.object.pose().yaw()));
}

std::string rowText(const ObjectRow& row)
{
  const MapObject& o = *row.object;
  const Eigen::Vector3d c = o.object.center(), size = 2 * o.object.semiAxes();
  std::string text = mrpt::format(
      "%5u  %-16s %8.3f %8.3f %8.3f  %6.3f %6.3f %6.3f  %7s  %5u  %6.2f", o.id, o.label().c_str(),
      c.x(), c.y(), c.z(), size.x(), size.y(), size.z(), yawText(o).c_str(), o.observations(),
      o.existence());
  if (row.distance) text += mrpt::format("  %8.3f", *row.distance);
  return text + "\n";
}

std::string footprintText(const CQuadricObjectMap& map, ObjectId id)
{
  std::string text = "       footprint [m]:";
  for (const mrpt::math::TPoint2D& corner : map.footprint(id))
    text += mrpt::format(" (%.3f, %.3f)", corner.x, corner.y);
  return text + "\n";
}

std::string labelCounts(const std::vector<const MapObject*>& objects)
{
  std::map<std::string, int> counts;
  for (const MapObject* object : objects) ++counts[object->label()];
  std::string text;
  for (const auto& [label, count] : counts)
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + label;
  return text;
}

}  // namespace

std::string objectTable(
    const CQuadricObjectMap& map, const std::vector<ObjectRow>& rows, bool withFootprints)
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
    if (withFootprints) text += footprintText(map, row.object->id);
  }
  return text;
}

std::string mapSummary(const CQuadricObjectMap& map, const std::string& path)
{
  const auto confirmed = map.confirmedObjects();
  std::string text = path + ": object map, " + std::to_string(confirmed.size()) + " objects";
  const std::size_t others = map.objects().size() - confirmed.size();
  if (others > 0) text += mrpt::format(" (and %zu without enough evidence)", others);
  text += "\n";
  if (confirmed.empty()) return text;

  auto first = confirmed.front()->firstSeen, last = confirmed.front()->lastSeen;
  for (const MapObject* object : confirmed)
  {
    first = std::min(first, object->firstSeen);
    last = std::max(last, object->lastSeen);
  }
  const auto bounds = map.boundingBox();
  const auto a = bounds.min.cast<double>(), b = bounds.max.cast<double>();
  text += "labels: " + labelCounts(confirmed) + "\n";
  text += mrpt::format(
      "extent: x %.2f ... %.2f, y %.2f ... %.2f, z %.2f ... %.2f m\n", a.x, b.x, a.y, b.y, a.z,
      b.z);
  text += "seen:   " + mrpt::system::dateTimeToString(first) + " ... " +
          mrpt::system::dateTimeToString(last) + " UTC\n\n";
  std::vector<ObjectRow> rows;
  for (const MapObject* object : confirmed) rows.push_back({object, std::nullopt});
  return text + objectTable(map, rows, false);
}

void requireLabel(const CQuadricObjectMap& map, const std::string& label, const std::string& path)
{
  const LabelTable& table = map.labels();
  if (table.properties(label).known || !map.withLabel(label).empty()) return;
  throw std::runtime_error(
      path + ": \"" + label + "\" is a label neither of its label table nor of its objects: " +
      labelCounts(map.confirmedObjects()));
}

}  // namespace quadmap
