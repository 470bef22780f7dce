#pragma once

#include <mrpt/system/COutputLogger.h>

#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "quadmap/base/OutputSet.h"
#include "quadmap/sensors/FrameSource.h"
#include "quadmap/slam/SlamConfiguration.h"
#include "quadmap/slam/SlamResult.h"

namespace quadmap
{
/** How far a run is. */
struct RunProgress
{
  double share = 0;                                   //!< Of the input, in [0, 1]
  std::size_t keyframes = 0;                          //!< That went through the pipeline
  const std::map<std::string, std::size_t>& objects;  //!< Number of confirmed ones by label
};

/** One call of quadmap-slam. */
struct RawlogRunRequest
{
  std::string rawlog;  //!< The recording, or for messages the name of `source`
  /** The input instead of a rawlog; null for the rawlog. */
  std::shared_ptr<FrameSource> source;
  bool isLive = false;              //!< `source` does not wait: it drops what is not taken in time
  std::string outputDirectory;      //!< It is made when it does not exist
  std::string objectsFile;          //!< Boxes; if empty, NAME.objects.rawlog or the rawlog
  std::string sensorLabel;          //!< The only RGB-D sensor to read; empty for all
  bool keepGoing = false;           //!< Leave out what is broken instead of failing
  CQuadricObjectMap::ConstPtr map;  //!< Map to continue; null for a new one
  std::string mapFile;              //!< Name of the map's file, for messages
  /** A run that was stopped early replaces the result of one that was not. Without it, its files
   * go into the folder `interrupted` of the output directory. */
  bool replaceComplete = false;
  SlamConfiguration configuration;
  std::string version;  //!< Version of the program, for the report

  /** Receives messages while it runs: warnings, and each keyframe as LVL_DEBUG. */
  std::function<void(mrpt::system::VerbosityLevel, const std::string&)> onMessage =
      [](mrpt::system::VerbosityLevel, const std::string&) {};
  std::function<void(const RunProgress&)> onProgress = [](const RunProgress&) {};
  std::function<bool()> shouldStop = [] { return false; };  //!< Asked often, by copies
  std::function<void()> onClosing = [] {};  //!< The result is computed, and is written next

  /** Writes more files of the same result. They appear together with the others. */
  std::function<void(const SlamResult&, OutputSet&)> addFiles = [](const SlamResult&, OutputSet&) {
  };
};

struct RawlogRunSummary
{
  SlamResult result;
  std::vector<std::string> dropped;  //!< What keepGoing left out, one line each
  std::string directory;             //!< Where the files are
  std::vector<std::string> files;    //!< Their names
  /** shouldStop() ended it, or the source failed; the files have what was done. */
  bool interrupted = false;
};

/** The run was told to stop before it had anything to write. */
struct RunStoppedEarly : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** Runs ObjectSlam on a rawlog and writes all files of the output directory, which appear together.
 * Two runs into one directory exclude each other.
 * \exception std::invalid_argument If the method cannot continue a map.
 * \exception std::runtime_error For a broken input. The message is one line that names file, record
 * and sensor where they are known. No file is then left behind.
 * \exception RunStoppedEarly When shouldStop() ends it before the first image. */
RawlogRunSummary runOnRawlog(const RawlogRunRequest& request);

}  // namespace quadmap
