#pragma once

#include <string>
#include <vector>

#include "quadmap/base/IniSections.h"
#include "quadmap/odometry/PoseUncertainty.h"
#include "quadmap/odometry/VisualOdometryOptions.h"
#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
/** A particle filter in an object map: section [localization] of the configuration. The equations
 * are those of doc/mathematics.md, section 14. */
struct LocalizationOptions : public OptionGroup
{
  int particles = 2000;  //!< Number of poses that are weighed, 100..1000000
  int seed = 1;          //!< Of all random numbers, >= 0

  double startMargin = 1.0;       //!< Poses start within the objects and this around them [m], >= 0
  double startHeightSigma = 0.1;  //!< ... and this far from the height of the odometry [m], >= 0
  double updateDistance = 0.05;   //!< Weigh again after this way of a camera [m], >= 0
  double updateAngle = fromDegrees(2.0L);  //!< ... or this turn [rad], >= 0; INI in degrees
  double floorShare = 0.5;    //!< Of the floor's tilt that an image takes out, in [0, 1]
  double searchShare = 0.25;  //!< Poses drawn anew from what is seen, while lost, in [0, 0.9]
  double doubtShare = 0.02;   //!< The same when all others agree, in [0, 0.9]

  double placeRadius = 0.5;                //!< Poses within this of the best place count [m], > 0
  double placeAngle = fromDegrees(20.0L);  //!< ... and within this turn [rad], > 0; INI in degrees
  double localisedShare = 0.8;   //!< Localised when this share of the weight is there, in (0, 1]
  double localisedSigma = 0.15;  //!< ... and spreads less than this [m], > 0
  double localisedAngle = fromDegrees(5.0L);  //!< ... and less than this [rad], > 0; INI in degrees

 private:
  void describe(OptionList& list) override;
};

/** All options of quadmap-localize, as one INI file. */
struct LocalizationConfiguration
{
  LocalizationOptions localization;  //!< [localization]
  PoseUncertaintyOptions poses;      //!< [poses]
  VisualOdometryOptions visual;      //!< [visual]
  PerceptionOptions perception;      //!< [perception]

  /** Reads the sections that the file has; exceptions as of readIniSections(). */
  static LocalizationConfiguration fromFile(const std::string& path);

  /** Every option with its value, its unit, its range and what it does, as the text of a file. */
  std::string documentedIni() const;

  std::vector<IniSection> sections();
};

}  // namespace quadmap
