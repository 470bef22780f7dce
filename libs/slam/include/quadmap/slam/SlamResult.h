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
#include "quadmap/slam/SlamOptions.h"
#include "quadmap/slam/graph/FactorGraph.h"
#include "quadmap/slam/relocalization/MapContinuation.h"
#include "quadmap/slam/visual/VisualOdometry.h"

namespace quadmap
{
/** An image of one sensor whose objects were looked at. It and its boxes are in the KeyframeSpool.
 */
struct Keyframe
{
  std::size_t record = 0;  //!< Of the range scan in its rawlog
  std::string sensor;      //!< Its label
  double time = 0;         //!< [s]
  mrpt::poses::CPose3D T_map_robot;
  mrpt::poses::CPose3D T_odom_robot;  //!< As given by the input
  /** Motion since the keyframe before, by the input, (x, y, z, yaw, pitch, roll); the first has
   *  none. */
  std::optional<mrpt::poses::CPose3DPDFGaussian> odometryStep = std::nullopt;
  /** Marginal covariance of T_map_robot in the same order, the first keyframe being exact where
   * it defines the map. Nothing when the method estimates none, or no pose. */
  std::optional<mrpt::math::CMatrixDouble66> covariance = std::nullopt;
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

  std::size_t boxes() const { return complete + partial + rejected; }
};

/** Of one sensor, or of all together. */
struct SlamCounts
{
  std::size_t frames = 0;             //!< RGB-D frames that reached the pipeline
  std::size_t framesWithoutPose = 0;  //!< ... and were left out for that
  std::size_t keyframes = 0;
  std::size_t keyframesWithoutBoxes = 0;     //!< Nobody looked for objects
  std::size_t keyframesWithoutDepth = 0;     //!< Not one valid depth
  std::size_t keyframesFromPixelLabels = 0;  //!< Their boxes were made of the scan's pixelLabels
  std::size_t boxes = 0;

  SlamCounts& operator+=(const SlamCounts& other);
};

/** How the final estimation of poses and objects went. */
struct CorrectionSummary
{
  int rounds = 0;          //!< Of association and optimisation that were made
  double lastMove = 0;     //!< Of any keyframe in the last one [m]
  bool converged = false;  //!< Nothing moved any more
};

/** Where the poses came from. */
struct OdometrySummary
{
  PoseSource source = PoseSource::Auto;        //!< Auto: the rawlog's, or a single moment
  std::string visualSensor;                    //!< The camera of visual odometry
  bool upFromFloor = false;                    //!< Else the first robot pose is taken for upright
  std::optional<VisualOdometryCounts> visual;  //!< When it was used
};

/** Everything a run found out, except what is in the KeyframeSpool. */
struct SlamResult
{
  CQuadricObjectMap map;
  std::vector<Keyframe> keyframes;     //!< In the order of the input; see poseNodesOf()
  std::vector<BoxDecision> decisions;  //!< In the order of keyframes and boxes
  std::map<std::string, SlamCounts> countsBySensor;
  OdometrySummary odometry;
  std::map<std::string, LabelCounts> labels;
  /** How much the final estimation knew of the objects from each keyframe, `pose`. Nothing when
   * there was no graph: the pose graph then has the uncertainty of the measurements. */
  std::vector<FactorGraph::PoseEdge> edges;
  std::optional<CorrectionSummary> correction;  //!< Nothing when poses were taken as given
  std::optional<MapContinuation> continuation;  //!< When it started in an existing map
  std::vector<std::string> warnings;

  SlamCounts counts() const;  //!< Of all sensors
};

}  // namespace quadmap
