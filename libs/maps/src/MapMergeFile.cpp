#include "quadmap/maps/MapMergeFile.h"

#include <mrpt/config/CConfigFile.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "quadmap/base/ConfigCheck.h"
#include "quadmap/base/Json.h"

namespace quadmap
{
namespace
{
constexpr int kDecimals = 6;

Json inputJson(const MergeInput& input)
{
  return {
      {      "file",      input.file},
      {    "sha256",    input.sha256},
      {"has_frames", input.hasFrames}
  };
}

Json idJson(const std::optional<ObjectId>& id) { return id ? Json(*id) : Json(); }

Json originJson(const MapMerge::Origin& origin)
{
  return {
      {   "id", origin.id != 0 ? Json(origin.id) : Json()},
      {  "own",                        idJson(origin.own)},
      {"other",                      idJson(origin.other)}
  };
}

Json conflictJson(const MapMerge::Conflict& conflict)
{
  Json json = {
      { "kind", nameOf(conflict.kind)},
      {"label",        conflict.label}
  };
  json.update(originJson(conflict.origin));
  if (conflict.kind == MapConflict::Moved)
    json["distance_m"] = rounded(conflict.distance, kDecimals);
  return json;
}

}  // namespace

std::string mergeToJson(
    const MapMerge& merge,
    const MergeInput& own,
    const MergeInput& other,
    const CQuadricObjectMap& merged)
{
  const auto& T = merge.match.T_map_local;
  Json place = Json::array(), sigmas = Json::array();
  for (const double value : {T.x(), T.y(), T.z(), T.yaw()})
    place.push_back(rounded(value, kDecimals));
  for (int i = 0; i < 4; ++i)
    sigmas.push_back(rounded(std::sqrt(merge.placeCovariance(i, i)), kDecimals));
  Json objects = Json::array(), conflicts = Json::array();
  for (const auto& origin : merge.origins)
  {
    Json object = originJson(origin);
    object["label"] = merged.find(origin.id)->label();
    object["confirmed"] = merged.find(origin.id)->confirmed;
    objects.push_back(object);
  }
  for (const auto& conflict : merge.conflicts) conflicts.push_back(conflictJson(conflict));
  const Json json = {
      {         "format",                      "quadmap-merge"},
      {        "version",                                    1},
      {           "unit",                                  "m"},
      {            "own",                       inputJson(own)},
      {          "other",                     inputJson(other)},
      {          "newer", merge.otherIsNewer ? "other" : "own"},
      {  "shift_and_yaw",                                place},
      {         "sigmas",                               sigmas},
      {       "log_odds",          rounded(merge.match.logOdds,kDecimals)},
      {"log_odds_second",    rounded(merge.match.secondLogOdds,                                    kDecimals)},
      {        "objects",                              objects       },
      {      "conflicts",                            conflicts         }
  };
  return jsonText(json, 1) + "\n";
}

MapMergeOptions readMergeOptions(const std::string& path)
{
  constexpr const char* kSection = "merging";
  requireReadableIni(path);
  const mrpt::config::CConfigFile config(path);
  if (!config.sectionExists(kSection))
    throw std::invalid_argument(path + ": has no section [" + kSection + "]");
  MapMergeOptions options;
  try
  {
    options.loadFromConfigFile(config, kSection);
  }
  catch (const std::invalid_argument& e)
  {
    throw std::invalid_argument(path + ": " + e.what());
  }
  return options;
}

}  // namespace quadmap
