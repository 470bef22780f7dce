#include "quadmap/slam/RelocalizationOptions.h"

#include "quadmap/base/OptionList.h"

namespace quadmap
{
void RelocalizationOptions::describe(OptionList& list)
{
  ConstellationOptions::describe(list);
  list.about(
      "How a run finds itself in the map given with --map, by objects, and the objects of a place "
      "it comes back to.");
  list.number(
      "mapSigma", mapSigma, {1e-3, 10}, "m",
      "How far the sides of known objects are from where the map has them, beyond its covariance. "
      "It covers the drift of the run that made the map. So tightly do known objects hold the "
      "poses.");
}

}  // namespace quadmap
