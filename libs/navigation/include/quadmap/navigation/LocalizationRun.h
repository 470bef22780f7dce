#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/navigation/LocalizationOptions.h"
#include "quadmap/navigation/ParticleLocalization.h"
#include "quadmap/obs/Trajectory.h"
#include "quadmap/odometry/PoseSource.h"

namespace quadmap
{
/** One call of quadmap-localize. */
struct LocalizationRequest
{
  std::string rawlog;
  std::string objectsFile;                 //!< Boxes; if empty, NAME.objects.rawlog or the rawlog
  std::string sensorLabel;                 //!< The only RGB-D sensor to read; empty for all
  bool keepGoing = false;                  //!< Leave out what is broken instead of failing
  PoseSource odometry = PoseSource::Auto;  //!< No graph
  CQuadricObjectMap::ConstPtr map;
  std::string mapFile;  //!< Name of the map's file, for messages and the report
  LocalizationConfiguration configuration;
  std::size_t threads = 1;  //!< >= 1

  std::function<void(const std::string&)> onWarning = [](const std::string&) {};
  /** Receives the share of the input that was read, in [0, 1], and the latest estimate. */
  std::function<void(double, const LocalizationEstimate&)> onProgress =
      [](double, const LocalizationEstimate&) {};
  std::function<bool()> shouldStop = [] { return false; };  //!< Asked often, by copies
};

/** The filter after one frame. */
struct LocalizationUpdate
{
  double time = 0;        //!< Of the frame [s]
  std::size_t boxes = 0;  //!< That may show an object of the map, by their labels
  LocalizationEstimate estimate;
};

struct LocalizationResult
{
  std::vector<LocalizationUpdate> updates;  //!< In the order of the frames
  std::size_t frames = 0, framesWithoutPose = 0;
  std::string odometry;              //!< Where the motion came from, for people
  std::vector<std::string> dropped;  //!< What keepGoing left out, one line each
  bool interrupted = false;
  double measureSeconds = 0;  //!< CPU time of the process for looking at the images [s]
  double filterSeconds = 0;   //!< Wall-clock time of the filter [s]

  /** T_map_robot after the updates that found the robot. */
  Trajectory trajectory() const;
  /** The first update from which on it was never lost again; nothing when the last one is lost. */
  std::optional<std::size_t> localisedFrom() const;
};

/** Finds the robot of a rawlog in a map.
 * \exception std::invalid_argument If the map has no confirmed object.
 * \exception std::runtime_error For a broken input, and when the robot was never found, unless the
 * run was interrupted. The message is one line that names file, record and sensor where they are
 * known. */
LocalizationResult localiseInMap(const LocalizationRequest& request);

/** The report in the form of doc/formats.md. \param version Of the program. */
std::string localizationToJson(
    const LocalizationRequest& request,
    const LocalizationResult& result,
    const std::string& version);

}  // namespace quadmap
