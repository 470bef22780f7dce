#include "files/EstimationJson.h"

#include "quadmap/base/Json.h"

namespace quadmap
{
Json correctionJson(const std::optional<CorrectionSummary>& correction)
{
  if (!correction) return nullptr;
  const StepNoise& noise = correction->stepNoise;
  return {
      {        "rounds",                   correction->rounds                        },
      {   "last_move_m",                                 rounded(correction->lastMove,6)},
      {     "converged",                                        correction->converged                                                            },
      {"odometry_noise",
       {{"position", rounded(noise.position, 3)}, {"angle", rounded(noise.angle, 3)}}}
  };
}

Json loopsJson(const LoopSummary& loops)
{
  Json open = nullptr;
  if (loops.open)
    open = {
        {   "objects",          loops.open->objects},
        { "distance_m", rounded(loops.open->distance,          3)}
    };
  return {
      { "closed",  loops.closed},
      {   "open",          open},
      {"stopped", loops.stopped}
  };
}

Json mapChangesJson(const std::optional<MapContinuation>& continuation)
{
  if (!continuation) return nullptr;
  const MapContinuation& c = *continuation;
  const auto& T = c.match.T_map_local;
  Json moved = Json::array(), pairs = Json::array();
  for (const auto& move : c.moved)
    moved.push_back({
        {      "from",             move.from},
        { "to",               move.to           },
        { "distance_m", rounded(move.distance,                               4)}
    });
  for (const auto& [local, known] : c.match.pairs) pairs.push_back(known);
  return {
      {    "map_objects",                     c.knownObjects                         },
      {          "found",                                                       pairs},
      {  "shift_and_yaw",
       {rounded(T.x(), 6), rounded(T.y(), 6), rounded(T.z(), 6), rounded(T.yaw(), 6)}},
      {       "log_odds",                                     rounded(c.match.logOdds,3)},
      {"log_odds_second",                               rounded(c.match.secondLogOdds,                                                           3)},
      {          "moved",                                                       moved               },
      {        "removed",                                                   c.removed },
      {          "added",                                                     c.added               }
  };
}

}  // namespace quadmap
