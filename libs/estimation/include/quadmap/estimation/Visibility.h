#pragma once

#include <mrpt/poses/CPose3D.h>

#include <optional>
#include <vector>

#include "quadmap/estimation/MapObject.h"
#include "quadmap/estimation/ObjectView.h"
#include "quadmap/geometry/ImageBox.h"
#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** Evidence for and against an object's existence, as log-odds. A detection adds ln(pD/pFA), a
 * frame that should have shown the object and did not adds ln((1-pD)/(1-pFA)). Both count as far as
 * they are independent of other looks. */
struct ExistenceOptions
{
  double detectionProbability = 0.5;  //!< Prior mean of pD, of a visible object, in (0, 1)
  /** Weight of that prior, and the most that an object's earlier looks weigh against it
   * [independent looks], > 0 */
  double detectionPriorWeight = 10;
  double falseAlarmProbability = 0.1;  //!< pFA: a box where nothing is, in (0, pD)
  /** The sizes of false alarms spread this much more than those of their label, >= 1. With 1 sizes
   * do not count. */
  double falseAlarmSpread = 2;
  double oddShare = 0.02;  //!< Share of real things whose sizes spread as much, in (0, 1]
  /** A detector repeats a mistake as long as it looks from the same place: a look, be it a
   * detection or a miss, counts in full when the camera has moved by this angle as seen from the
   * object since any other one. */
  double independentViewAngle = 0.1;  //!< [rad], > 0; INI `independentViewAngle_deg`
  double independentViewTime = 10;    //!< ... or has been away for so long [s], > 0
  double repeatedViewWeight = 0.25;   //!< Share of a repeated look that is independent, in (0, 1]
  double maxLogOdds = 10;             //!< Bound, so that evidence can turn, > 0
  double confirmLogOdds = 2.2;        //!< Reported above this; 2.2 is nine to one
  int minObservations = 2;            //!< Reported with this many measurements of any kind, >= 1
  int minComplete = 1;                //!< ... of which this many complete, >= 1
  int minPartial = 8;                 //!< ... or with this many measurements of any kind, >= 1
  double maxCenterSigma = 0.2;        //!< Reported below this uncertainty per axis [m], > 0

  double minLabelShare = 0.5;   //!< ... when this share of the labels agrees with its own, [0, 1]
  double maxSizeDeviation = 3;  //!< Sizes from partial measurements: spreads off the label's, > 0
  double maxSizeSigma = 0.5;    //!< ... and the uncertainty of its half sizes below this [m], > 0

  double minRange = 0.5, maxRange = 4.5;  //!< Where misses count: centre to camera [m]
  /** ... and of the projected box both sides are this, or what they were when it was seen [px] */
  double minBoxSize = 30;
  double visibleShare = 0.4;    //!< Share of the projected box inside the image, (0, 1]
  double occluderMargin = 0.1;  //!< Depth this much nearer than the object hides it [m]
  double maxHiddenShare = 0.5;  //!< Of the box's cells hidden or without depth, [0, 1]
};

/** One frame's camera in the map. */
struct FrameGeometry
{
  PinholeCamera camera;
  mrpt::poses::CPose3D T_map_sensor;
  const CoarseDepth* depth = nullptr;  //!< May be null or empty: unknown

  /** The object in the camera's optical frame. */
  Ellipsoid toOptical(const Ellipsoid& object_map) const;
};

/** Should a detector have been able to see the object in this frame? False when in doubt: nothing
 * is known of what hides it without depth. \param minBoxSize Both sides of its projected box, when
 * it is large enough [px]. */
bool shouldBeVisible(
    const Ellipsoid& object,
    const FrameGeometry& frame,
    const ExistenceOptions& options,
    double minBoxSize);

/** Is more of the object behind things of the map than existence.maxHiddenShare? Things count as
 * their cuboids, and hide what is wholly behind them, not what stands on them, is in them or
 * overlaps them; so an object does not hide itself. \param camera Its place in the map [m]. */
bool isBehind(
    const Ellipsoid& object,
    const std::vector<Ellipsoid>& things,
    const Eigen::Vector3d& camera,
    const ExistenceOptions& options);

/** Box of the object's outline in the image: of the cuboid or the ellipsoid, whichever the shape
 * exponent is nearer to; not clipped. */
std::optional<ImageBox> projectedBox(
    const Ellipsoid& object, const FrameGeometry& frame, double shapeExponent);

}  // namespace quadmap
