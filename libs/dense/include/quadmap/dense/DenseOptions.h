#pragma once

#include "quadmap/base/OptionGroup.h"

namespace quadmap
{
/** How dense clouds are made and used: section [dense] of a configuration. */
struct DenseOptions : public OptionGroup
{
  double roomCell = 0.01;       //!< Edge of the cubes that keep one point of the room [m], > 0
  double objectCell = 0.005;    //!< The same for the points of objects [m], > 0
  double maxRange = 4.0;        //!< Depth beyond this is ignored as noisy [m], > 0
  unsigned maxKeyframes = 400;  //!< Most keyframes that are read, spread evenly, > 0
  unsigned minHits = 2;         //!< Fewest pixels that saw a point, > 0
  /** A point has at least this share of the weight (the inverse of the variance) of the heaviest
   * point in the cubes around its own, in [0, 1). */
  double minWeightShare = 0.2;
  int outlierNeighbours = 20;      //!< A point is compared with so many around it, >= 2
  double outlierDeviations = 2.5;  //!< ... and dropped when farther from them than the mean
                                   //!< distance plus this many standard deviations, > 0
  int normalNeighbours = 24;       //!< A normal is that of the plane through so many points, >= 3

  double boxShare = 0.8;        //!< An object's points lie in this share of its boxes, in [0.5, 1]
  double clearance = 0.004;     //!< Points nearer to a support or a wall belong to it [m], >= 0
  double growDistance = 0.025;  //!< Largest gap between the points of one part [m], > 0
  double smoothingRadius = 0.01;  //!< An object's points move onto the plane of those so near [m]

  double surfaceTolerance = 0.02;  //!< Points so near to a surface lie on it [m], > 0

 private:
  void describe(OptionList& list) override;
};

/** Reads section [dense] of an INI file, strictly.
 * \exception std::runtime_error, std::invalid_argument For a file that cannot be read, one
 * without the section, and a value that makes no sense; the message names file, section and key. */
DenseOptions readDenseOptions(const std::string& path);

}  // namespace quadmap
