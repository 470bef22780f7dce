#pragma once

namespace quadmap
{
struct EstimatorOptions
{
  int maxMeasurements = 150;  //!< Of one object that are kept; redundant ones go, >= 3
  int maxIterations = 25;     //!< Of the optimiser, >= 1
  /** Residuals beyond this many sigmas lose weight, lower bounds of sizes most of it, > 0. */
  double huber = 1.5;
  double edgeFloor = 0.002;  //!< Fixed part of what is added to an edge's sigma [m], >= 0
  /** By this share of the mean half size all edges of one side of an object err alike, >= 0: a
   * detector draws its boxes alike in all images. */
  double edgeShapeShare = 0.06;
  bool edgesOfComplete =
      true;  //!< Use the box edges of complete measurements with unseen sides too
  double roundnessSigma = 0.1;   //!< Of ln(a/b) for labels without dominant direction [-], > 0
  double sizePriorSpread = 1.0;  //!< Factor on the label table's spread of sizes, > 0
  /** Of the seed of a partial measurement, (0, 1]. What is behind a thin or sparse object is taken
   * for it in most frames alike: ten seeds are worth one. */
  double seedWeight = 0.1;
  /** Share of the variance of what a view errs by itself, without its pose, that views from the
   * same place have in common, [0, 1]. */
  double repeatedThere = 0.65;
  /** The same of views from anywhere, [0, repeatedThere]. */
  double repeatedAnywhere = 0.25;
  double repeatedAngle = 0.4;  //!< How fast the one becomes the other [rad], > 0
  /** Standard deviation of the relative error of all depth of a sensor, >= 0: what is left of it
   * after a usual calibration. Many views do not average it out. */
  double depthScaleSigma = 0.005;
};

}  // namespace quadmap
