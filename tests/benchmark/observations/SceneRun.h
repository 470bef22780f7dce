#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/obs/LabelTable.h"
#include "quadmap/perception/PerceptionOptions.h"
#include "quadmap/simulator/Simulator.h"

namespace quadmap::observations
{
/** Which simulated frames are looked at. */
struct RunOptions
{
  /** Name of an installed scene, path of a scene file, or "random": another room per seed. */
  std::string scene = "home";
  std::vector<std::uint64_t> seeds = {1, 2, 3};
  int width = 320, height = 240;  //!< Of the images [px]
  std::size_t framesStep = 1;     //!< Every n-th frame, >= 1
};

/** What a detector box really shows. */
struct TrueObject
{
  std::size_t index = 0;  //!< In Scene::objects
  std::string name, label;
  Ellipsoid object_sensor;
  bool orientationDefined = true;
  simulator::VisibleObject visible;  //!< Its exact box and how much of it is seen
};

/** One frame as the pipeline sees it at its true pose. */
struct ObservedFrame
{
  std::uint64_t seed = 0;
  std::size_t index = 0;  //!< In the simulated walk
  simulator::SimulatedFrame simulated;
  mrpt::poses::CPose3D T_map_sensor;  //!< The true one
  CObservationObjects boxes;          //!< With their measurements
  /** Of each box of `boxes`; nothing for false alarms. */
  std::vector<std::optional<TrueObject>> truth;
};

/** Walks through a scene with each seed, measures all boxes at the true poses, with the floor
 * tracked from frame to frame as in quadmap-slam. Nothing is written to files.
 * \param visit Called with each frame, in their order.
 * \exception std::runtime_error For a scene that cannot be read. */
void runScene(
    const RunOptions& run,
    const PerceptionOptions& perception,
    const LabelTable& labels,
    const std::function<void(const ObservedFrame&)>& visit);

}  // namespace quadmap::observations
