#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstddef>

#include "quadmap/obs/DetectedObject.h"

namespace quadmap
{
/** An equality constraint: the face was measured or is given by the support. */
inline bool isEquality(FaceKind kind)
{
  return kind == FaceKind::Measured || kind == FaceKind::Support;
}

/** What one measurement says of its object, in the frame of whoever keeps it: the map's for an
 * ObjectView and the robot's for a BoxMeasurement of the factor graph. */
struct MeasuredGeometry
{
  Eigen::Vector3d camera = Eigen::Vector3d::Zero();  //!< Camera centre [m]

  /** Complete: the cuboid's centre. Partial: the seed pushed inwards by half the typical depth. */
  Eigen::Vector3d center = Eigen::Vector3d::Zero();

  bool complete = false;    //!< True when a cuboid was measured
  bool yawDefined = false;  //!< True when a cuboid with a heading was measured
  double yawSigma = 0;      //!< Standard deviation of the heading [rad]
  Eigen::Vector3d halfSizes = Eigen::Vector3d::Ones();  //!< [m]; partial: typical ones
  std::array<FaceMeasurement, kFaces> faces;            //!< All Unknown when not complete
  /** Exponent of the h_q that the faces touch: 2, or the label's for a cuboid without a heading,
   * whose faces touch corners. */
  double faceExponent = 2.0;

  /** True when both sides of axis 0..2 were measured. */
  bool axisKnown(std::size_t axis) const
  {
    return isEquality(faces[2 * axis].kind) && isEquality(faces[2 * axis + 1].kind);
  }
  /** True when the four side faces and the top were measured. Box edges are loose, as detectors
   * are, and then add nothing. */
  bool allSidesKnown() const
  {
    for (std::size_t f = 0; f + 1 < kFaces; ++f)
      if (!isEquality(faces[f].kind)) return false;
    return true;
  }
};

}  // namespace quadmap
