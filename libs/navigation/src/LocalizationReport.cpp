#include <nlohmann/json.hpp>

#include "quadmap/base/Json.h"
#include "quadmap/navigation/LocalizationRun.h"

namespace quadmap
{
namespace
{
Json poseJson(const LocalizationUpdate& update)
{
  const auto& T = update.estimate.T_map_robot;
  return {
      {     "time",                                       rounded(update.time, 6)},
      { "position", {rounded(T.x(), 6), rounded(T.y(), 6), rounded(T.z(), 6)}   },
      {      "yaw",                                           rounded(T.yaw(), 6)},
      {    "share",                             rounded(update.estimate.share, 4)},
      {    "sigma",                             rounded(update.estimate.sigma, 6)},
      {"sigma_yaw",                          rounded(update.estimate.yawSigma, 6)},
      {"localised",                               update.estimate.isLocalised   },
      {    "boxes",                                              update.boxes   }
  };
}

}  // namespace

std::string localizationToJson(
    const LocalizationRequest& request,
    const LocalizationResult& result,
    const std::string& version)
{
  Json updates = Json::array();
  for (const auto& update : result.updates) updates.push_back(poseJson(update));
  Json start = nullptr;
  if (const auto from = result.localisedFrom())
    start = {
        {          "time", rounded(result.updates[*from].time, 6)},
        {"updates_before",                              *from   }
    };
  const Json report = {
      {         "format","quadmap-localization"                         },
      {        "version",                                            1},
      {           "unit",                                          "m"},
      {          "frame",                                        "map"},
      {"program_version",                                      version},
      {          "input",
       {{"file", request.rawlog},
       {"map", request.mapFile},
       {"odometry", result.odometry},
       {"frames", result.frames},
       {"frames_without_pose", result.framesWithoutPose},
       {"interrupted", result.interrupted}}                           },
      {      "particles", request.configuration.localization.particles},
      {           "seed",      request.configuration.localization.seed},
      {      "localised",                                        start},
      {        "updates",                                      updates},
      {        "dropped",                               result.dropped}
  };
  return jsonText(report, 2) + "\n";
}

}  // namespace quadmap
