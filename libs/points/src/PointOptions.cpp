#include "quadmap/points/PointOptions.h"

#include "quadmap/base/OptionList.h"

namespace quadmap
{
void PointOptions::describe(OptionList& list)
{
  list.about(
      "Method point: objects that are points. The Dirichlet process is that of the map, the rounds "
      "are those of [joint].");
  list.number(
      "centerSigma", centerSigma, {0, 10}, "m",
      "Standard deviation of a measured centre, beyond the measurement's own uncertainty.");
  list.number(
      "huber", huber, {0.1, 100}, "sigmas", "Measurements farther off than this count linearly.");
  list.number(
      "maxConfusion", maxConfusion, {1e-6, 1}, "",
      "A measurement joins an object when fewer than this many others are to be expected where the "
      "object may be, as seen from the robot. Otherwise it starts an object of its own, which may "
      "turn out to be a double.");
  list.number(
      "minJoinPosterior", minJoinPosterior, {0, 0.999}, "",
      "A measurement joins an object only with at least this probability.");
  list.number(
      "mergeLogOdds", mergeLogOdds, {0.1, 1000}, "ln",
      "Objects mapped twice become one when it is exp() of this more likely that they are.");
  list.number(
      "mergeMargin", mergeMargin, {0, 1000}, "ln",
      "They become one only when that is exp() of this more likely than what contradicts it.");
  list.number(
      "finalMergeLogOdds", finalMergeLogOdds, {0.1, 1000}, "ln",
      "The same as mergeLogOdds at the end, when no more evidence is to come.");
  list.integer(
      "matureObservations", matureObservations, {1, 1000}, "",
      "An object takes part in merging from so many measurements on.");
  list.integer(
      "forgetAfter", forgetAfter, {1, 100000}, "frames",
      "An object that was seen once is given up after so many frames.");
  list.integer(
      "minObservations", minObservations, {1, 1000}, "",
      "Fewest measurements of a reported object.");
  list.number(
      "falseAlarmProbability", falseAlarmProbability, {1e-6, 0.49}, "",
      "Probability of a measurement where nothing is, per frame.");
  list.number(
      "confirmLogOdds", confirmLogOdds, {-1000, 1000}, "ln",
      "An object is reported above these log-odds of its existence.");
}

}  // namespace quadmap
