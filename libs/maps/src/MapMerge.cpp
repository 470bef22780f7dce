#include "quadmap/maps/MapMerge.h"

#include "quadmap/base/OptionList.h"

namespace quadmap
{
void MapMergeOptions::describe(OptionList& list)
{
  ConstellationOptions::describe(list);
  list.about("How two maps of one place become one.");
  list.number(
      "staySigma", staySigma, {1e-3, 10}, "m",
      "How far an object that stayed may seem to have moved between the maps, beyond the "
      "uncertainty of both. It covers the sides that only one of them saw.");
  list.number(
      "errorCorrelation", errorCorrelation, {0, 1}, "",
      "Correlation of what the two maps err by about an object, as both see the same sides of it "
      "with the same perception. 0: they are independent.");
}

std::string nameOf(MapConflict kind)
{
  switch (kind)
  {
    case MapConflict::Moved:
      return "moved";
    case MapConflict::Gone:
      return "gone";
    case MapConflict::New:
      return "new";
    case MapConflict::OnlyOne:
      break;
  }
  return "only one";
}

}  // namespace quadmap
