#pragma once

#include <Eigen/Dense>
#include <cstddef>

#include "quadmap/estimation/BoxMeasurement.h"
#include "quadmap/estimation/ResidualRow.h"
#include "quadmap/estimation/RobustKernel.h"

namespace quadmap
{
/** Pose of the robot in the map. */
struct RobotPose
{
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();  //!< [m]
};

/** Which derivatives the rows carry. */
enum class RowDerivatives
{
  OfObject,  //!< Those by the object
  OfObjectAndPose
};

/** The robust kernels of a measurement's rows. */
struct RowKernels
{
  double threshold;  //!< [sigmas], > 0
  /** A side or an edge far from the object pulls at it the less the farther it is,
   * doc/mathematics.md, (11.28). Else it pulls however far it is, as it has to while it may be a
   * pose that is wrong. */
  bool fade = false;

  RobustKernel ofEdge() const
  {
    return fade ? RobustKernel::cauchy(threshold) : RobustKernel::huber(threshold);
  }
  /** An *at least* face is an inequality. */
  RobustKernel ofFace(FaceKind kind) const
  {
    return kind == FaceKind::AtLeast ? RobustKernel::inequality(threshold) : ofEdge();
  }
};

/** A measurement as it is seen from one pose of the robot: the rows of the sum (11.1) of
 * doc/mathematics.md, of the map and of the factor graph alike. All rows have their exact
 * derivatives. */
class ViewAtPose
{
 public:
  /** \param measurement In the robot's frame. It must outlive this object. */
  ViewAtPose(
      const BoxMeasurement& measurement,
      const RobotPose& pose,
      ObjectFreedom freedom,
      RowDerivatives derivatives);

  /** Number of rows that forEachRow() gives. It does not depend on any state. */
  static std::size_t rowCount(const BoxMeasurement& measurement, ObjectFreedom freedom);

  /** Calls add(row, sigma, kernel) for each row: faces, heading or angles, edges, seed.
   * \param object With the same freedom. \param q Of the label, for the box edges. */
  template <typename Add>
  void forEachRow(
      const ObjectShape& object, double q, const RowKernels& kernels, const Add& add) const
  {
    const RobustKernel kernel = RobustKernel::huber(kernels.threshold);
    for (std::size_t f = 0; m_.complete && f < kFaces; ++f)
      if (m_.faces[f].kind != FaceKind::Unknown)
        add(face(f, object), m_.faces[f].sigma, kernels.ofFace(m_.faces[f].kind));
    if (hasYawRow(m_, freedom_)) add(yaw(object), m_.yawSigma, kernel);
    for (int i = 0; i < tiltRows(m_, freedom_); ++i) add(tilt(i), m_.tiltSigma, kernel);
    for (int i = 0; i < turnRows(m_, freedom_); ++i)
      add(turn(i, object), i < 2 ? m_.tiltSigma : m_.yawSigma, kernel);
    for (const auto& e : m_.edges) add(edge(e, object, q), e.sigma, kernels.ofEdge());
    for (int i = 0; m_.hasSeed && i < 3; ++i) add(seed(i, object), 1.0, kernel);
  }

  /** Gap of face 0..5 [m], (11.2): positive when the object is smaller than the face says. */
  ResidualRow face(std::size_t f, const ObjectShape& object) const;
  /** Heading of an upright object [rad], (11.4). */
  ResidualRow yaw(const ObjectShape& object) const;
  /** What is up in the measurement against what is up in the map, along x or y [rad], (16.5). */
  ResidualRow tilt(int axis) const;
  /** Turn of a free object from the measurement about one axis of the cuboid [rad], (16.4). */
  ResidualRow turn(int axis, const ObjectShape& object) const;
  /** Gap between a box edge and the object [m], (11.5). */
  ResidualRow edge(const BoxMeasurement::Edge& e, const ObjectShape& object, double q) const;
  /** Coordinate i of the whitened seed [-], (11.9). */
  ResidualRow seed(int i, const ObjectShape& object) const;

 private:
  static bool hasYawRow(const BoxMeasurement& m, ObjectFreedom freedom)
  {
    return m.complete && m.yawDefined && freedom == ObjectFreedom::Upright;
  }
  static int tiltRows(const BoxMeasurement& m, ObjectFreedom freedom)
  {
    return m.complete && m.tiltSigma > 0 && freedom == ObjectFreedom::Upright ? 2 : 0;
  }
  static int turnRows(const BoxMeasurement& m, ObjectFreedom freedom)
  {
    if (!m.complete || m.tiltSigma <= 0 || freedom == ObjectFreedom::Upright) return 0;
    return m.yawDefined ? 3 : 2;
  }

  const BoxMeasurement& m_;
  RobotPose pose_;
  ObjectFreedom freedom_;
  bool withPose_;
  Eigen::Matrix3d axes_;                              // of the cuboid, in the map
  Eigen::Vector3d measuredUp_;                        // its z axis before it was turned upright
  Eigen::Vector3d fromRobot_;                         // from the robot to the measured centre
  double yaw_ = 0;                                    // of the cuboid turned upright
  Eigen::Vector3d d_yaw_ = Eigen::Vector3d::UnitZ();  // by a turn of the pose
};

}  // namespace quadmap
