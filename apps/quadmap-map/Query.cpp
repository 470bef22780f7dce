#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "Commands.h"
#include "ObjectTable.h"
#include "common/CommandLine.h"
#include "quadmap/base/ConfigCheck.h"

namespace quadmap
{
namespace
{
/** The arguments of the query. */
struct Cli
{
  using Text = TCLAP::ValueArg<std::string>;

  cli::CommandLine line{
      "quadmap-map query",
      "Lists the objects that fulfil all conditions given; all objects without any.",
      QUADMAP_VERSION};
  TCLAP::UnlabeledValueArg<std::string> file{"FILE",     "An objects.quadmap.", true, "", "FILE",
                                             line.args()};
  Text label{"", "label", "Only objects of this label.", false, "", "LABEL", line.args()};
  Text near{"",      "near",     "Nearest to this place first, with distances [m].", false, "",
            "x,y,z", line.args()};
  Text region{"",         "region", "Only objects whose centre lies in this box [m].",
              false,      "",       "x1,y1,z1,x2,y2,z2",
              line.args()};
  TCLAP::ValueArg<unsigned> id{"", "id", "Only this object.", false, 0, "N", line.args()};
  TCLAP::SwitchArg footprint{"", "footprint", "Show the outlines on the floor.", line.args()};
  TCLAP::SwitchArg json{"", "json", "Print in the form of objects.json.", line.args()};
};

/** "1,2,3" of an argument as numbers; `count` of them. */
std::vector<double> numbersOf(TCLAP::ValueArg<std::string>& argument, std::size_t count)
{
  std::vector<double> numbers;
  const std::string text = argument.getValue() + ",";
  for (std::size_t from = 0, to; (to = text.find(',', from)) != std::string::npos; from = to + 1)
  {
    const auto number = parseNumber(text.substr(from, to - from));
    if (number && std::isfinite(*number))
      numbers.push_back(*number);
    else
      break;
  }
  const auto commas = static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
  if (numbers.size() != count || commas != count)
    throw cli::UsageError(
        "--" + argument.getName() + ": expected " + std::to_string(count) +
        " numbers with commas between, got '" + argument.getValue() + "'");
  return numbers;
}

std::vector<const MapObject*> candidates(Cli& cli, const CQuadricObjectMap& map)
{
  if (cli.id.isSet())
  {
    const MapObject* object = map.find(cli.id.getValue());
    if (!object)
      throw std::runtime_error(
          cli.file.getValue() + ": has no object with id " + std::to_string(cli.id.getValue()));
    return {object};
  }
  return cli.label.isSet() ? map.withLabel(cli.label.getValue()) : map.confirmedObjects();
}

/** Keeps what is in both lists. */
void intersect(std::vector<const MapObject*>& list, const std::vector<const MapObject*>& other)
{
  const auto isMissing = [&](const MapObject* object)
  { return std::find(other.begin(), other.end(), object) == other.end(); };
  list.erase(std::remove_if(list.begin(), list.end(), isMissing), list.end());
}

std::vector<ObjectRow> rowsOf(Cli& cli, const CQuadricObjectMap& map)
{
  std::vector<const MapObject*> objects = candidates(cli, map);
  if (cli.id.isSet() && cli.label.isSet()) intersect(objects, map.withLabel(cli.label.getValue()));
  if (cli.region.isSet())
  {
    const std::vector<double> v = numbersOf(cli.region, 6);
    intersect(
        objects, map.inRegion(mrpt::math::TBoundingBox::FromUnsortedPoints(
                     {v[0], v[1], v[2]}, {v[3], v[4], v[5]})));
  }
  std::vector<ObjectRow> rows;
  for (const MapObject* object : objects) rows.push_back({object, std::nullopt});
  if (!cli.near.isSet()) return rows;
  const std::vector<double> p = numbersOf(cli.near, 3);
  for (ObjectRow& row : rows)
    row.distance = (row.object->object.center() - Eigen::Vector3d(p[0], p[1], p[2])).norm();
  std::stable_sort(
      rows.begin(), rows.end(),
      [](const ObjectRow& a, const ObjectRow& b) { return *a.distance < *b.distance; });
  return rows;
}

/** In the order of the rows. */
std::string jsonOf(const CQuadricObjectMap& map, const std::vector<ObjectRow>& rows)
{
  std::vector<ObjectRecord> found;
  const std::vector<ObjectRecord> records = map.toRecords();
  for (const ObjectRow& row : rows)
    for (const ObjectRecord& record : records)
      if (record.id == std::to_string(row.object->id)) found.push_back(record);
  return objectsToJson(found);
}

}  // namespace

void queryCommand(int argc, char** argv)
{
  Cli cli;
  if (!cli.line.parse(argc, argv)) return;
  if (cli.json.getValue() && cli.footprint.getValue())
    throw cli::UsageError("--footprint and --json: the form of objects.json has no footprints");
  CQuadricObjectMap map;
  map.loadFromFile(cli.file.getValue());
  if (cli.label.isSet()) requireLabel(map, cli.label.getValue(), cli.file.getValue());
  const std::vector<ObjectRow> rows = rowsOf(cli, map);
  std::cout
      << (cli.json.getValue() ? jsonOf(map, rows)
                              : objectTable(map, rows, cli.footprint.getValue()));
}

}  // namespace quadmap
