#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/maps/CQuadricObjectMap.h"

namespace quadmap
{
/** A frame whose objects were looked at. Its images and boxes are in the KeyframeSpool. */
struct Keyframe
{
  std::size_t record = 0;  //!< Of the range scan in its rawlog
  double time = 0;         //!< [s]
  mrpt::poses::CPose3D T_map_robot;
  mrpt::poses::CPose3D T_odom_robot;  //!< As given by the input
  /** Motion since the keyframe before, by the input, (x, y, z, yaw, pitch, roll); the first has
   *  none. */
  std::optional<mrpt::poses::CPose3DPDFGaussian> odometryStep = std::nullopt;
};

/** Which object a box was taken for. */
struct BoxDecision
{
  std::uint32_t keyframe = 0;
  CQuadricObjectMap::Decision decision;
};

/** What became of the boxes of one label. */
struct LabelCounts
{
  std::size_t complete = 0, partial = 0, rejected = 0;
  std::map<std::string, std::size_t> reasons;  //!< "complete: ..." -> how often
};

struct SlamCounts
{
  std::size_t frames = 0;                 //!< RGB-D frames that reached the pipeline
  std::size_t framesWithoutPose = 0;      //!< ... and were left out for that
  std::size_t keyframesWithoutBoxes = 0;  //!< Nobody looked for objects
  std::size_t keyframesWithoutDepth = 0;  //!< Not one valid depth
  std::size_t boxes = 0;
};

/** Everything a run found out, except what is in the KeyframeSpool. */
struct SlamResult
{
  CQuadricObjectMap map;
  std::vector<Keyframe> keyframes;
  std::vector<BoxDecision> decisions;  //!< In the order of keyframes and boxes
  SlamCounts counts;
  std::map<std::string, LabelCounts> labels;
  std::vector<std::string> warnings;
};

}  // namespace quadmap
