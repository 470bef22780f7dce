#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <string>
#include <vector>

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

/** One measurement of one object in the map frame, as the estimator and the association use it.
 * Sigmas include the pose's uncertainty. */
struct ObjectView
{
  struct Edge
  {
    Plane plane;       //!< In the map, normal towards the object
    double angle = 0;  //!< Standard deviation as an angle at the camera [rad]
  };

  std::string label;                                 //!< Canonical
  Eigen::Vector3d camera = Eigen::Vector3d::Zero();  //!< Camera centre [m]
  double positionSigma = 0;                          //!< Of the camera centre [m]

  /** Complete: the cuboid's centre. Partial: the seed pushed inwards by half the typical depth. */
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d centerCovariance = Eigen::Matrix3d::Identity();

  bool complete = false;
  double yaw = 0;  //!< Of the cuboid's x axis [rad]; the cuboid is turned upright
  bool yawDefined = false;
  double yawSigma = 0;                                  //!< [rad]
  Eigen::Vector3d halfSizes = Eigen::Vector3d::Ones();  //!< [m]; partial: typical ones
  std::array<FaceMeasurement, kFaces> faces;            //!< All Unknown when not complete
  /** Of the h_q the faces touch: 2, and the label's when the cuboid was measured without a heading:
   * then its faces touch the object's corners. */
  double faceExponent = 2.0;

  std::vector<Edge> edges;  //!< The usable box edges

  /** Outward normal of face 0..5 (+x, -x, +y, -y, +z, -z) in the map. */
  Eigen::Vector3d faceNormal(std::size_t face) const { return faceNormals()[face]; }
  std::array<Eigen::Vector3d, kFaces> faceNormals() const;
  /** n . x of the points of that face, n the outward normal [m]. */
  double faceOffset(std::size_t face) const { return faceOffset(face, faceNormal(face)); }
  double faceOffset(std::size_t face, const Eigen::Vector3d& normal) const
  {
    return normal.dot(center) + halfSizes[static_cast<Eigen::Index>(face / 2)];
  }
  /** Both sides of axis 0..2 were measured. */
  bool axisKnown(std::size_t axis) const;
  /** The four side faces and the top were measured: box edges, loose as detectors are, add nothing.
   */
  bool allSidesKnown() const;
};

/** A detected object's measurement in the map; nothing when it is not usable (no measurement, or a
 * cuboid and a seed both missing).
 * \param properties Of the label; its `name` becomes the view's label. */
std::optional<ObjectView> viewOf(
    const DetectedObject& detected,
    const mrpt::poses::CPose3D& T_map_sensor,
    const LabelProperties& properties,
    const PoseNoise& noise);

/** Equality constraint: the face was measured or is given by the support. */
inline bool isEquality(FaceKind kind)
{
  return kind == FaceKind::Measured || kind == FaceKind::Support;
}

}  // namespace quadmap
