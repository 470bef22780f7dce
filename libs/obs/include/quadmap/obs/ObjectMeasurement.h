#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "quadmap/geometry/Ellipsoid.h"
#include "quadmap/geometry/Plane.h"

namespace quadmap
{
/** What one face of a measured cuboid tells the estimation. */
enum class FaceKind : std::uint8_t
{
  Unknown = 0,  //!< Nothing is known about this face
  Measured,     //!< The object ends here: a surface or a free rim was seen (an equality)
  Support,      //!< The supporting plane gives the face (an equality)
  AtLeast       //!< Far or hidden face: the object reaches here or farther (an inequality)
};

struct FaceMeasurement
{
  FaceKind kind = FaceKind::Unknown;
  double sigma = 0;  //!< Standard deviation of the face's distance along its normal [m]
};

/** Faces are numbered +x, -x, +y, -y, +z, -z of the object's frame. */
constexpr std::size_t kFaces = 6;

/** The object as one depth image shows it: doc/mathematics.md, section 8. The object's z axis is
 * the normal of the supporting plane. */
struct CompleteMeasurement
{
  Ellipsoid object_sensor;  //!< In the sensor frame (x forward)
  std::array<FaceMeasurement, kFaces> faces;
  bool yawDefined = false;  //!< False when the cloud shows no dominant direction
  double yawSigma = 0;      //!< [rad], when yawDefined
  /** Share of the histogram of normals in its peak, or of a top's rim on straight sides, in [0, 1]
   */
  double yawDominance = 0;
};

enum class EdgeState : std::uint8_t
{
  Usable = 0,
  NearImageBorder,  //!< The object may continue outside the image
  Occluded,         //!< Something nearer hides the object's real edge
};

/** One box edge as a plane through the camera centre, tangent to the object. */
struct EdgeMeasurement
{
  Plane plane_sensor;     //!< In the sensor frame, d = 0, normal towards the object
  double sigmaAngle = 0;  //!< sigma_px / f [rad]; times the range it is a distance
  EdgeState state = EdgeState::Usable;
};

enum class MeasurementKind : std::uint8_t
{
  None = 0,  //!< Perception has not looked at the box yet
  Complete,
  Partial,
  Rejected
};

const char* nameOf(MeasurementKind kind);  //!< One lower-case word

/** What perception made of one detector box. */
struct ObjectMeasurement
{
  MeasurementKind kind = MeasurementKind::None;
  std::string reason;  //!< Why this kind, in words a user understands

  double projectedIoU = 0;   //!< p: IoU(box of the projected cuboid, detected box); 0 = no cuboid
  double depthCoverage = 0;  //!< Share of the box's pixels with valid depth, in [0, 1]

  /** A point on the object's visible surface, sensor frame [m]: the seed for association. */
  std::optional<Eigen::Vector3d> seed_sensor;

  std::optional<CompleteMeasurement> complete;  //!< Set when kind is Complete
  /** Box edges left, top, right, bottom; set when kind is Complete or Partial. */
  std::optional<std::array<EdgeMeasurement, 4>> edges;
};

}  // namespace quadmap
