#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/estimation/MeasuredGeometry.h"
#include "quadmap/geometry/Plane.h"
#include "quadmap/obs/DetectedObject.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** Uncertainty of the poses the observations are inserted at. */
struct PoseNoise
{
  double position = 0.015;  //!< Standard deviation of each coordinate [m], >= 0
  double angle = 0.012;     //!< Standard deviation of the orientation [rad], >= 0
};

/** One measurement of one object in the map, as the estimator and the association use it. The
 * sigmas include the uncertainty of the pose. */
struct ObjectView : MeasuredGeometry
{
  struct Edge
  {
    Plane plane;       //!< In the map, normal towards the object
    double angle = 0;  //!< Standard deviation as an angle at the camera [rad]
  };

  std::string label;     //!< Canonical
  PoseNoise pose{0, 0};  //!< Of the pose it was taken from; the sigmas include it
  Eigen::Matrix3d centerCovariance = Eigen::Matrix3d::Identity();  //!< Of `center` [m^2]
  double wrongDepthSigma = 0;  //!< Of a partial view's range when its depth is another thing's [m]
  bool hasOwnDepth = true;  //!< False: the depth is more likely another thing's (see measurementOf)
  double yaw = 0;           //!< Of the cuboid's x axis [rad]; the cuboid is turned upright
  std::vector<Edge> edges;  //!< The usable box edges
  /** The faces where the image ends: nobody could see how much farther the object reaches. */
  std::array<bool, kFaces> isCutByImage = {};

  /** Outward normal of face 0..5 (+x, -x, +y, -y, +z, -z) in the map. */
  Eigen::Vector3d faceNormal(std::size_t face) const { return faceNormals()[face]; }
  std::array<Eigen::Vector3d, kFaces> faceNormals() const;
  /** n . x of the points of that face, n the outward normal [m]. */
  double faceOffset(std::size_t face) const
  {
    return faceNormal(face).dot(center) + halfSizes[static_cast<Eigen::Index>(face / 2)];
  }
};

/** The usable edges of a measured box in the map. */
std::vector<ObjectView::Edge> usableEdges(
    const ObjectMeasurement& measurement,
    const mrpt::poses::CPose3D& T_map_sensor,
    const PoseNoise& noise);

/** A detected object's measurement in the map; nothing when it is not usable (no measurement, or a
 * cuboid and a seed both missing).
 * \param properties Of the label; its `name` becomes the view's label. */
std::optional<ObjectView> viewOf(
    const DetectedObject& detected,
    const mrpt::poses::CPose3D& T_map_sensor,
    const LabelProperties& properties,
    const PoseNoise& noise);

}  // namespace quadmap
