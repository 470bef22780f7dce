#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/graph/FactorGraph.h"
#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/odometry/UpDirection.h"
#include "quadmap/odometry/VisualOdometry.h"
#include "quadmap/slam/MapContinuation.h"
#include "quadmap/slam/SlamOptions.h"

namespace quadmap
{
/** A frame of one sensor that was kept with a pose. Its image and boxes are in the KeyframeSpool.
 */
struct Keyframe
{
  std::size_t record = 0;  //!< Index of the range scan in its rawlog
  std::string sensor;      //!< Its label
  double time = 0;         //!< [s]
  mrpt::poses::CPose3D T_map_robot;
  mrpt::poses::CPose3D T_odom_robot;  //!< Pose by the input's odometry
  /** Motion since the keyframe before by the input's odometry, with its covariance (x, y, z, yaw,
   *  pitch, roll). The first keyframe has none. */
  std::optional<mrpt::poses::CPose3DPDFGaussian> odometryStep = std::nullopt;
  /** Marginal covariance of T_map_robot in the same order. The first keyframe is exact when it
   * defines the map. It is empty when the method estimates no poses or no covariances. */
  std::optional<mrpt::math::CMatrixDouble66> covariance = std::nullopt;
};

/** Which object a box was associated with. */
struct BoxDecision
{
  std::uint32_t keyframe = 0;
  CQuadricObjectMap::Decision decision;
};

/** What became of the boxes of one label. */
struct LabelCounts
{
  std::size_t complete = 0, partial = 0, rejected = 0;
  std::map<std::string, std::size_t>
      reasons;  //!< How often each reason, "complete: ...", was given

  std::size_t boxes() const { return complete + partial + rejected; }
};

/** Numbers of frames and boxes of one sensor, or of all together. */
struct SlamCounts
{
  std::size_t frames = 0;             //!< RGB-D frames that were given to the run
  std::size_t framesWithoutPose = 0;  //!< Of these, left out for want of a pose
  std::size_t keyframes = 0;
  std::size_t keyframesWithoutBoxes = 0;     //!< No detector looked at them
  std::size_t keyframesWithoutDepth = 0;     //!< They have no valid depth
  std::size_t keyframesFromPixelLabels = 0;  //!< Their boxes come from pixelLabels
  std::size_t boxes = 0;

  SlamCounts& operator+=(const SlamCounts& other);
};

/** How the final estimation of poses and objects went. */
struct CorrectionSummary
{
  int rounds = 0;          //!< Rounds of association and optimisation
  double lastMove = 0;     //!< Largest move of a keyframe in the last round [m]
  bool converged = false;  //!< The last round moved hardly anything
  StepNoise stepNoise;     //!< What the odometry was found to err by
};

/** Places that the run came back to without noticing, so that their objects were twice in the map.
 */
struct LoopSummary
{
  int closed = 0;  //!< Times that such objects became one, and everything was estimated anew

  /** Objects that are twice in the map. Poses and objects are doubtful then. */
  struct Open
  {
    std::size_t objects = 0;
    double distance = 0;  //!< Largest distance between the two of one thing [m]
  };
  std::optional<Open> open = std::nullopt;
  /** The run was told to stop before all such objects were found, or in the moment when they were.
   */
  bool stopped = false;

  /** Says so when there are some, or may be; empty otherwise. */
  std::string warning() const;
};

/** Where the poses came from. */
struct OdometrySummary
{
  PoseSource source = PoseSource::Auto;        //!< Auto means a single moment
  std::string visualSensor;                    //!< The camera of visual odometry
  UpOrigin upOrigin = UpOrigin::Images;        //!< What told visual odometry where up is
  std::optional<VisualOdometryCounts> visual;  //!< Set when it was used
};

/** Everything that a run found out, except what is in the KeyframeSpool. */
struct SlamResult
{
  CQuadricObjectMap map;
  std::vector<Keyframe> keyframes;     //!< In the order of the input; see poseNodesOf()
  std::vector<BoxDecision> decisions;  //!< In the order of keyframes and boxes
  std::map<std::string, SlamCounts> countsBySensor;
  OdometrySummary odometry;
  std::map<std::string, LabelCounts> labels;
  /** What the final estimation knew of the objects from each keyframe, whose index is `pose`. It is
   * empty without a factor graph; the written pose graph then has the uncertainty of the
   * measurements. */
  std::vector<FactorGraph::GraphEdge> edges;
  std::optional<CorrectionSummary> correction;  //!< Empty when poses were taken as given
  LoopSummary loops;                            //!< Of the final estimation
  std::optional<MapContinuation> continuation;  //!< Set when it continued a map
  std::size_t droppedFloors = 0;                //!< See RoomPlanes::droppedFloors()
  std::vector<std::string> warnings;

  SlamCounts counts() const;  //!< Of all sensors
};

}  // namespace quadmap
