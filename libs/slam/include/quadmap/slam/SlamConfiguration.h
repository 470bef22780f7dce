#pragma once

#include <mrpt/config/CConfigFileMemory.h>

#include <functional>
#include <string>
#include <vector>

#include "quadmap/base/IniSections.h"
#include "quadmap/base/OptionGroup.h"
#include "quadmap/base/OptionList.h"
#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/odometry/PoseUncertainty.h"
#include "quadmap/odometry/VisualOdometryOptions.h"
#include "quadmap/perception/PerceptionOptions.h"
#include "quadmap/points/PointOptions.h"
#include "quadmap/sensors/KeyframeSelector.h"
#include "quadmap/slam/JointOptions.h"
#include "quadmap/slam/RelocalizationOptions.h"
#include "quadmap/slam/SlamOptions.h"

namespace quadmap
{
/** All options of a run, as one INI file. share/quadmap/quadmap.ini lists them with their defaults;
 * it is what documentedIni() of the defaults gives. */
struct SlamConfiguration
{
  SlamOptions slam;                                     //!< [slam]
  InputOptions input;                                   //!< [input]
  KeyframeOptions keyframes;                            //!< [keyframes]
  PoseUncertaintyOptions poses;                         //!< [poses]
  JointOptions joint;                                   //!< [joint]
  PointOptions point;                                   //!< [point]
  RelocalizationOptions relocalization;                 //!< [relocalization]
  VisualOdometryOptions visual;                         //!< [visual]
  PerceptionOptions perception;                         //!< [perception]
  CQuadricObjectMap::TInsertionOptions mapInsertion;    //!< [CQuadricObjectMap_insertOpts]
  CQuadricObjectMap::TLikelihoodOptions mapLikelihood;  //!< [CQuadricObjectMap_likelihoodOpts]
  CQuadricObjectMap::TRenderOptions mapRender;          //!< [CQuadricObjectMap_renderOpts]

  /** Reads the sections that the file has. All other options keep their defaults.
   * \exception std::runtime_error If the file cannot be read.
   * \exception std::invalid_argument For unknown sections and keys and for bad values; the message
   * starts with the file's name. */
  static SlamConfiguration fromFile(const std::string& path);

  /** Every option with its value. */
  mrpt::config::CConfigFileMemory toConfig() const;

  /** Calls `each` with the section and the description of every option, to take texts from. */
  void visitOptions(const std::function<void(const std::string&, const Option&)>& each) const;

  /** Every option with its value, its unit, its range and what it does, as the text of a file. */
  std::string documentedIni() const;

 private:
  std::vector<IniSection> sections();
};

}  // namespace quadmap
