#include "Commands.h"

#include <mrpt/system/datetime.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include "ObjectTable.h"
#include "common/CommandLine.h"
#include "quadmap/maps/MapEdits.h"
#include "quadmap/maps/MapFile.h"

namespace quadmap
{
namespace
{
using Text = TCLAP::ValueArg<std::string>;
using Id = TCLAP::ValueArg<unsigned>;

/** What the sub-commands that change a map have in common. */
struct EditCli
{
  EditCli(const std::string& command, const std::string& description) :
      line("quadmap-map " + command, description, QUADMAP_VERSION)
  {
  }

  /** Writes the changed map and says so. */
  void write(const CQuadricObjectMap& map)
  {
    map.saveToFile(output.getValue());
    std::cout << "wrote " << output.getValue() << " with " << map.confirmedObjects().size()
              << " objects\n";
  }

  cli::CommandLine line;
  TCLAP::UnlabeledValueArg<std::string> file{"MAP", kMapHelp, true, "", "MAP", line.args()};
  Text output{"o",           "output",   "The changed map; may be the same file.", true, "",
              "out.quadmap", line.args()};
};

void requireObject(const CQuadricObjectMap& map, ObjectId id, const std::string& path)
{
  if (!map.find(id))
    throw std::runtime_error(path + ": has no object with id " + std::to_string(id));
}

/** When the confirmed objects were seen, as a line; empty when there is none. */
std::string timesSeen(const CQuadricObjectMap& map)
{
  const auto confirmed = map.confirmedObjects();
  if (confirmed.empty()) return "";
  auto first = confirmed.front()->firstSeen, last = confirmed.front()->lastSeen;
  for (const MapObject* object : confirmed)
  {
    first = std::min(first, object->firstSeen);
    last = std::max(last, object->lastSeen);
  }
  return "seen:   " + mrpt::system::dateTimeToString(first) + " ... " +
         mrpt::system::dateTimeToString(last) + " UTC\n";
}

}  // namespace

void infoCommand(int argc, char** argv)
{
  cli::CommandLine line("quadmap-map info", "Shows what a map contains.", QUADMAP_VERSION);
  line.addExample("quadmap-map info home/objects.quadmap", "Lists its objects.");
  TCLAP::UnlabeledValueArg<std::string> file(
      "MAP", std::string(kMapHelp) + " Or an objects.json.", true, "", "MAP", line.args());
  if (!line.parse(argc, argv)) return;
  const std::string& path = file.getValue();
  if (isObjectList(path))
    std::cout << mapSummary(readInventory(path), path, "");
  else
  {
    const CQuadricObjectMap map = readMap(path);
    std::cout << mapSummary(inventoryOf(map), path, timesSeen(map));
  }
}

void relabelCommand(int argc, char** argv)
{
  EditCli cli("relabel", "Gives an object another label.");
  cli.line.addExample(
      "quadmap-map relabel home/objects.quadmap --id 7 --label armchair -o corrected.quadmap",
      "Calls object 7 an armchair.");
  Id id("", "id", "The object.", true, 0, "N", cli.line.args());
  Text label("", "label", "Its new label.", true, "", "LABEL", cli.line.args());
  TCLAP::SwitchArg anyLabel(
      "", "any-label", "Take a label that neither the map's label table nor its objects have.",
      cli.line.args());
  if (!cli.line.parse(argc, argv)) return;
  if (label.getValue().empty()) throw cli::UsageError("--label: must not be empty");
  CQuadricObjectMap map = readMap(cli.file.getValue());
  requireObject(map, id.getValue(), cli.file.getValue());
  if (!anyLabel.getValue()) requireLabel(inventoryOf(map), label.getValue(), cli.file.getValue());
  map.relabel(id.getValue(), label.getValue());
  cli.write(map);
}

void removeCommand(int argc, char** argv)
{
  EditCli cli("remove", "Takes objects out of a map.");
  cli.line.addExample(
      "quadmap-map remove home/objects.quadmap --id 3 --id 5 -o corrected.quadmap",
      "Leaves out two objects.");
  TCLAP::MultiArg<unsigned> ids(
      "", "id", "An object; may be given several times.", true, "N", cli.line.args());
  if (!cli.line.parse(argc, argv)) return;
  CQuadricObjectMap map = readMap(cli.file.getValue());
  for (const unsigned id : ids.getValue())
  {
    requireObject(map, id, cli.file.getValue());
    map.remove(id);
  }
  cli.write(map);
}

void mergeCommand(int argc, char** argv)
{
  EditCli cli("merge", "Makes one object of two that are the same.");
  cli.line.addExample(
      "quadmap-map merge home/objects.quadmap --keep 1 --absorb 2 -o corrected.quadmap",
      "Makes object 2 a part of object 1.");
  Id kept("", "keep", "The object that stays.", true, 0, "N", cli.line.args());
  Id absorbed("", "absorb", "The object that goes into it.", true, 0, "N", cli.line.args());
  if (!cli.line.parse(argc, argv)) return;
  if (kept.getValue() == absorbed.getValue())
    throw cli::UsageError("--keep and --absorb: must be two objects");
  CQuadricObjectMap map = readMap(cli.file.getValue());
  requireObject(map, kept.getValue(), cli.file.getValue());
  requireObject(map, absorbed.getValue(), cli.file.getValue());
  map.merge(kept.getValue(), absorbed.getValue());
  cli.write(map);
}

void applyCommand(int argc, char** argv)
{
  EditCli cli("apply", "Makes the changes of an edit list, as the page of a map saves it.");
  cli.line.addExample(
      "quadmap-map apply home/objects.quadmap edits.json -o corrected.quadmap",
      "Applies what was changed in the page.");
  TCLAP::UnlabeledValueArg<std::string> list(
      "EDITS", "The list (.json).", true, "", "EDITS", cli.line.args());
  if (!cli.line.parse(argc, argv)) return;
  const std::vector<MapEdit> edits = readMapEdits(list.getValue());
  CQuadricObjectMap map = readMap(cli.file.getValue());
  try
  {
    applyEdits(edits, map);
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error(list.getValue() + ": " + e.what());
  }
  cli.write(map);
}

}  // namespace quadmap
