#include "quadmap/constellation/ConstellationOptions.h"

#include "quadmap/base/OptionList.h"

namespace quadmap
{
void ConstellationOptions::describe(OptionList& list)
{
  list.about("How the objects of two maps of one place find each other.");
  list.number(
      "positionSigma", positionSigma, {1e-3, 10}, "m",
      "How far an object is from its place in the map, beyond the uncertainty of both. It covers "
      "the drift of the run and the sides that only one of the two saw.");
  list.angle(
      "yawSigma_deg", yawSigma, {0.01, 90},
      "How far the heading of an object is from that in the map, beyond the uncertainty of both.");
  list.number(
      "maxSizeLogRatio", maxSizeLogRatio, {0.01, 10}, "ln",
      "Two objects are alike when no size differs by more than this.");
  list.number(
      "minLabelAgreement", minLabelAgreement, {0, 1}, "",
      "Two objects are alike when the labels of at least this share of their measurements agree.");
  list.number(
      "knownShare", knownShare, {0.01, 0.99}, "",
      "Share of the objects in the area of the map that the map has. The others were moved or "
      "brought.");
  list.integer(
      "minPairs", minPairs, {2, 1000}, "",
      "Fewest objects that are found again. One fewer will do when one of them has a heading.");
  list.number(
      "minLogOdds", minLogOdds, {0.01, 1000}, "ln",
      "The place must be exp() of this more likely than any other and than chance. Objects are "
      "gone when that is as sure.");
}

}  // namespace quadmap
