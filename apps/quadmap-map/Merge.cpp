#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <string>

#include "Commands.h"
#include "EditCli.h"
#include "quadmap/base/ErrorText.h"
#include "quadmap/base/OutputFile.h"
#include "quadmap/base/OutputSet.h"
#include "quadmap/base/Sha256.h"
#include "quadmap/maps/MapFile.h"
#include "quadmap/maps/MapMergeFile.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

struct MergeCli : EditCli
{
  MergeCli() :
      EditCli(
          "merge",
          "Makes one map of two of the same place, in the frame of the first: objects that both "
          "have are estimated together, and what was moved, went or came is told. OUT.merge.json "
          "says where everything comes from. Or, with --keep and --absorb, makes one object of two "
          "in one map.")
  {
    line.addExample(
        "quadmap-map merge monday tuesday -o both.quadmap", "Merges the maps of two recordings.");
    line.addExample(
        "quadmap-map merge home/objects.quadmap --keep 1 --absorb 2 -o corrected.quadmap",
        "Makes object 2 a part of object 1.");
  }

  /** Which of the two it is. \exception cli::UsageError If it is neither or both. */
  bool isOfMaps()
  {
    const bool ofObjects = kept.isSet() && absorbed.isSet();
    if (other.isSet() && (kept.isSet() || absorbed.isSet()))
      throw cli::UsageError("--keep and --absorb: belong to one map, not to two");
    if (!other.isSet() && !ofObjects)
      throw cli::UsageError("merge: give a second map, or --keep and --absorb");
    if (!other.isSet() && config.isSet()) throw cli::UsageError("--config: belongs to two maps");
    if (other.getValue().size() > 1) throw cli::UsageError("merge: two maps at a time");
    if (ofObjects && kept.getValue().value == absorbed.getValue().value)
      throw cli::UsageError("--keep and --absorb: must be two objects");
    return other.isSet();
  }

  /** At most one. TCLAP remembers a single optional one for all commands, and then refuses theirs.
   */
  TCLAP::UnlabeledMultiArg<std::string> other{
      "OTHER", "A second map of the same place.", false, "OTHER", line.args()};
  Text config{"c",        "config",   "Section [merging]: how two maps become one.", false, "",
              "FILE.ini", line.args()};
  Id kept{"", "keep", "The object that stays.", false, {}, "N", line.args()};
  Id absorbed{"", "absorb", "The object that goes into it.", false, {}, "N", line.args()};
};

void mergeObjects(MergeCli& cli)
{
  CQuadricObjectMap map = readMap(cli.file.getValue());
  requireObject(map, cli.kept.getValue().value, cli.file.getValue());
  requireObject(map, cli.absorbed.getValue().value, cli.file.getValue());
  map.merge(cli.kept.getValue().value, cli.absorbed.getValue().value);
  cli.write(map);
}

/** Two maps that are merged, and their names. */
struct TwoMaps
{
  explicit TwoMaps(MergeCli& cli) :
      ownName(cli.file.getValue()),
      otherName(cli.other.getValue().front()),
      map(readMap(ownName)),
      other(readMap(otherName))
  {
  }

  std::string ownName, otherName;
  CQuadricObjectMap map, other;
};

/** A merge is undone by going back to the maps: they must stay.
 * \exception cli::UsageError If one of them would be replaced. */
void requireNewFile(const TwoMaps& maps, const std::string& output)
{
  if (!fs::exists(output)) return;
  for (const std::string* name : {&maps.ownName, &maps.otherName})
    if (fs::equivalent(output, mapFileOf(*name)))
      throw cli::UsageError("-o: must not be one of the two maps, which stay as they are");
}

std::string checksumOf(const std::string& file)
{
  return file.empty() ? std::string() : sha256OfFile(file);
}

/** Merged with itself, a map would count all its frames twice.
 * \exception cli::UsageError If the maps, or the frames beside them, are the same file. */
void requireTwoMaps(const TwoMaps& maps)
{
  const std::string frames = checksumOf(framesFileOf(maps.ownName));
  if (checksumOf(mapFileOf(maps.ownName)) == checksumOf(mapFileOf(maps.otherName)) ||
      (!frames.empty() && frames == checksumOf(framesFileOf(maps.otherName))))
    throw cli::UsageError(
        "merge: " + maps.ownName + " and " + maps.otherName + " are maps of the same frames");
}

std::string quantity(std::size_t n, const char* thing)
{
  return std::to_string(n) + " " + thing + (n == 1 ? "" : "s");
}

std::string conflictText(const MapMerge::Conflict& conflict, const TwoMaps& maps)
{
  const auto& [id, own, other] = conflict.origin;
  std::string from;
  if (own) from = std::to_string(*own) + " of " + maps.ownName;
  if (other) from += (own ? ", " : "") + std::to_string(*other) + " of " + maps.otherName;
  const bool isOnlyOne = conflict.kind == MapConflict::OnlyOne;
  std::string text =
      isOnlyOne ? "only in " + (own ? maps.ownName : maps.otherName) : nameOf(conflict.kind);
  text += ": " + oneLine(conflict.label);
  if (id != 0) text += " " + std::to_string(id);
  text += " (" + from + ")";
  if (conflict.kind == MapConflict::Moved) text += mrpt::format(" by %.3f m", conflict.distance);
  return text;
}

std::string summaryOf(const MapMerge& merge, const TwoMaps& maps)
{
  const auto& T = merge.match.T_map_local;
  const Eigen::Matrix4d& P = merge.placeCovariance;
  std::string text = mrpt::format(
      "%s in %s: shift (%.3f, %.3f, %.3f) m, yaw %.2f deg, known to %.3f m and %.2f deg\n",
      maps.otherName.c_str(), maps.ownName.c_str(), T.x(), T.y(), T.z(), mrpt::RAD2DEG(T.yaw()),
      std::sqrt(P.diagonal().head<3>().maxCoeff()), mrpt::RAD2DEG(std::sqrt(P(3, 3))));
  for (const auto& conflict : merge.conflicts) text += conflictText(conflict, maps) + "\n";
  return text;
}

/** OUT.merge.json beside OUT.quadmap. */
std::string reportNameOf(const fs::path& output) { return output.stem().string() + ".merge.json"; }

void write(const TwoMaps& maps, const MapMerge& merge, const fs::path& output)
{
  const auto inputOf = [](const std::string& name)
  {
    const std::string file = mapFileOf(name);
    return MergeInput{file, sha256OfFile(file), static_cast<bool>(framesOf(name))};
  };
  OutputSet files(output.parent_path().string(), output.filename().string());
  maps.map.saveToFile(files.add(output.filename().string()));
  writeTextFile(
      files.add(reportNameOf(output)),
      mergeToJson(merge, inputOf(maps.ownName), inputOf(maps.otherName), maps.map));
  files.commit();
}

void mergeMaps(MergeCli& cli)
{
  const fs::path output = cli.output.getValue();
  TwoMaps maps(cli);
  requireTwoMaps(maps);
  requireNewFile(maps, output.string());
  const MapMergeOptions options =
      cli.config.isSet() ? readMergeOptions(cli.config.getValue()) : MapMergeOptions();
  const std::size_t own = maps.map.confirmedObjects().size();
  const auto merge =
      maps.map.mergeMap(maps.other, options, framesOf(maps.ownName), framesOf(maps.otherName));
  if (!merge)
    throw std::runtime_error(
        maps.otherName + ": it cannot be told where this is in " + maps.ownName + ": its " +
        quantity(maps.other.confirmedObjects().size(), "object") + " were compared with " +
        std::to_string(own));
  std::ostream& out = cli.messages();
  write(maps, *merge, output);
  out << summaryOf(*merge, maps);
  cli.tellWritten(maps.map, out);
}

}  // namespace

void mergeCommand(int argc, char** argv)
{
  MergeCli cli;
  if (!cli.parse(argc, argv)) return;
  if (cli.isOfMaps())
    mergeMaps(cli);
  else
    mergeObjects(cli);
}

}  // namespace quadmap
