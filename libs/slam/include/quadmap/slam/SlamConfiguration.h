#pragma once

#include <mrpt/config/CConfigFileMemory.h>

#include <functional>
#include <string>
#include <vector>

#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/perception/PerceptionOptions.h"
#include "quadmap/slam/JointOptions.h"
#include "quadmap/slam/KeyframeSelector.h"
#include "quadmap/slam/PoseUncertainty.h"
#include "quadmap/slam/SlamOptions.h"
#include "quadmap/slam/points/PointOptions.h"
#include "quadmap/slam/relocalization/RelocalizationOptions.h"
#include "quadmap/slam/visual/VisualOdometryOptions.h"

namespace quadmap
{
/** All options of a run, as one INI file; share/quadmap/quadmap.ini lists them. */
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

  /** Reads the sections the file has; the rest keeps its default.
   * \exception std::runtime_error If the file cannot be read.
   * \exception std::invalid_argument For unknown sections and keys and for bad values; the message
   * starts with the file's name. */
  static SlamConfiguration fromFile(const std::string& path);

  /** Every option with its value. */
  mrpt::config::CConfigFileMemory toConfig() const;

 private:
  struct Section
  {
    std::string name;
    mrpt::config::CLoadableOptions* options;
  };
  std::vector<Section> sections();
};

}  // namespace quadmap
