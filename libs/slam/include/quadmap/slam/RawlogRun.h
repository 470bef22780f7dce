#pragma once

#include <mrpt/system/COutputLogger.h>

#include <functional>
#include <string>
#include <vector>

#include "quadmap/slam/SlamConfiguration.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** One call of quadmap-slam. */
struct RawlogRunRequest
{
  std::string rawlog;
  std::string outputDirectory;      //!< Made when missing
  std::string objectsFile;          //!< Boxes; empty: NAME.objects.rawlog or the rawlog itself
  std::string sensorLabel;          //!< Empty: all RGB-D sensors
  bool keepGoing = false;           //!< Leave out what is broken instead of failing
  CQuadricObjectMap::ConstPtr map;  //!< To start in and to carry on; null: a new one
  std::string mapFile;              //!< Its name, for messages
  SlamConfiguration configuration;
  std::string version;  //!< Of the program, for the report

  /** What is worth telling while it runs: warnings, and each keyframe as LVL_DEBUG. */
  std::function<void(mrpt::system::VerbosityLevel, const std::string&)> onMessage =
      [](mrpt::system::VerbosityLevel, const std::string&) {};
  std::function<void(double)> onProgress = [](double) {};   //!< Share of the rawlog, in [0, 1]
  std::function<bool()> shouldStop = [] { return false; };  //!< Asked before every frame
};

struct RawlogRunSummary
{
  SlamResult result;
  std::vector<std::string> dropped;  //!< What keepGoing left out, one line each
  std::vector<std::string> files;    //!< Written, with their paths
  bool interrupted = false;          //!< shouldStop() ended it; the files hold what was done
};

/** Streams a rawlog through ObjectSlam and writes all files of the output directory.
 * \exception std::invalid_argument If a map is to be carried on by a method that cannot.
 * \exception std::runtime_error With one line that names file, record and sensor where known. No
 * file is then left behind. */
RawlogRunSummary runOnRawlog(const RawlogRunRequest& request);

}  // namespace quadmap
