#pragma once

#include "quadmap/base/OptionGroup.h"

namespace quadmap
{
/** How points and poses are estimated together. The first six fields come from other sections; the
 * rest are the keys of [point]. */
struct PointOptions : public OptionGroup
{
  // The Dirichlet process and the optimiser; the program takes them from its other sections.
  double alpha = 0.5;             //!< Concentration of the Dirichlet process, > 0
  double beta = 0.1;              //!< Dirichlet prior of the label histogram, > 0
  int rounds = 5;                 //!< Of optimisation and association at the end, at most, >= 1
  double smallMove = 0.002;       //!< The rounds end when no pose moved farther [m], > 0
  int maxIterations = 30;         //!< Of one optimisation, >= 1
  bool associationGiven = false;  //!< By `instance` of the measurements; those without are clutter

  double centerSigma = 0.05;  //!< Of a measured centre, beyond the measurement's own [m], >= 0
  double huber = 2.0;         //!< Measurements farther off than this count linearly [sigmas], > 0

  /** A measurement joins an object when fewer than this many others are to be expected where the
   * object may be, as seen from the robot. Otherwise it starts an object of its own, which may turn
   * out to be a double. In (0, 1]. */
  double maxConfusion = 0.005;
  double minJoinPosterior = 0.5;  //!< ... and with at least this probability, in [0, 1)

  /** Objects mapped twice become one when it is exp() of this more likely that they are, > 0. */
  double mergeLogOdds = 6.0;
  double mergeMargin = 4.0;        //!< ... by this more than for what contradicts it, >= 0
  double finalMergeLogOdds = 2.0;  //!< The same at the end, when no more is to come, > 0
  int matureObservations = 3;      //!< An object takes part in that from so many on, >= 1
  int forgetAfter = 40;            //!< Frames after which an object seen once is given up, >= 1

  int minObservations = 3;              //!< Of a reported object, >= 1
  double falseAlarmProbability = 0.05;  //!< Of a measurement where nothing is, in (0, 0.5)
  double confirmLogOdds = 3.0;          //!< Reported above this

 private:
  void describe(OptionList& list) override;
};

}  // namespace quadmap
