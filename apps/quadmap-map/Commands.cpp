#include "Commands.h"

#include <mrpt/system/datetime.h>

#include <algorithm>
#include <iostream>
#include <string>

#include "EditCli.h"
#include "ObjectTable.h"
#include "quadmap/base/Sha256.h"
#include "quadmap/maps/MapEdits.h"
#include "quadmap/maps/MapFile.h"

namespace quadmap
{
namespace
{
constexpr const char* kAnyLabelHelp =
    "Take a label that neither the map's label table nor its objects have.";

/** \exception std::runtime_error If the list was made for another map, or for another state of it.
 */
void requireSameMap(
    const MapEditList& edits, const std::string& listPath, const std::string& mapPath)
{
  if (!edits.mapSha256.empty() && edits.mapSha256 != sha256OfFile(mapFileOf(mapPath)))
    throw std::runtime_error(
        listPath + ": was made for another map than " + mapPath +
        ", or for another state of it: its numbers may name other objects here; --any-map applies "
        "it all the same");
}

/** \exception std::runtime_error If the list gives a label that the map does not know. */
void requireLabels(
    const MapEditList& edits, const Inventory& inventory, const std::string& listPath)
{
  for (const MapEdit& edit : edits.edits)
    if (edit.kind == MapEdit::Kind::Relabel) requireLabel(inventory, edit.label, listPath);
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
  Id id("", "id", "The object.", true, {}, "N", cli.line.args());
  Text label("", "label", "Its new label.", true, "", "LABEL", cli.line.args());
  TCLAP::SwitchArg anyLabel("", "any-label", kAnyLabelHelp, cli.line.args());
  if (!cli.parse(argc, argv)) return;
  CQuadricObjectMap map = readMap(cli.file.getValue());
  requireObject(map, id.getValue().value, cli.file.getValue());
  if (!anyLabel.getValue()) requireLabel(inventoryOf(map), label.getValue(), cli.file.getValue());
  map.relabel(id.getValue().value, label.getValue());
  cli.write(map);
}

void removeCommand(int argc, char** argv)
{
  EditCli cli("remove", "Takes objects out of a map.");
  cli.line.addExample(
      "quadmap-map remove home/objects.quadmap --id 3 --id 5 -o corrected.quadmap",
      "Leaves out two objects.");
  TCLAP::MultiArg<IdNumber> ids(
      "", "id", "An object; may be given several times.", true, "N", cli.line.args());
  if (!cli.parse(argc, argv)) return;
  CQuadricObjectMap map = readMap(cli.file.getValue());
  for (const auto& [id] : ids.getValue())
  {
    requireObject(map, id, cli.file.getValue());
    map.remove(id);
  }
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
  TCLAP::SwitchArg anyMap(
      "", "any-map", "Apply a list that was made for another map, or for another state of it.",
      cli.line.args());
  TCLAP::SwitchArg anyLabel("", "any-label", kAnyLabelHelp, cli.line.args());
  if (!cli.parse(argc, argv)) return;
  const MapEditList edits = readMapEdits(list.getValue());
  CQuadricObjectMap map = readMap(cli.file.getValue());
  if (!anyMap.getValue()) requireSameMap(edits, list.getValue(), cli.file.getValue());
  if (!anyLabel.getValue()) requireLabels(edits, inventoryOf(map), list.getValue());
  try
  {
    applyEdits(edits.edits, map);
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error(list.getValue() + ": " + e.what());
  }
  cli.write(map);
}

}  // namespace quadmap
