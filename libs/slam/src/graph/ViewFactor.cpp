#include <ceres/cost_function.h>

#include <array>
#include <cmath>

#include "RobustRow.h"
#include "quadmap/geometry/RotationDistance.h"
#include "quadmap/geometry/RotationVector.h"
#include "quadmap/geometry/Support.h"
#include "quadmap/slam/graph/GraphFactors.h"

namespace quadmap
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

struct PoseAt
{
  explicit PoseAt(const double* block) :
      q(block),
      R(Eigen::Quaterniond(q).normalized().toRotationMatrix()),
      t(Eigen::Map<const Vector3d>(block + 4))
  {
  }
  Eigen::Map<const Eigen::Quaterniond> q;
  Matrix3d R;
  Vector3d t;
};

struct ObjectAt
{
  ObjectAt(const double* block, ObjectFreedom freedom) : t(Eigen::Map<const Vector3d>(block))
  {
    if (freedom == ObjectFreedom::Upright)
    {
      yaw = block[3];
      R = Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
    }
    else
    {
      const Eigen::Map<const Eigen::Quaterniond> q(block + 3);
      R = Eigen::Quaterniond(q).normalized().toRotationMatrix();
    }
    const int sizes = freedom == ObjectFreedom::Upright ? 4 : 7;
    s = Eigen::Map<const Vector3d>(block + sizes).array().exp();
  }
  Vector3d t;
  Matrix3d R;
  Vector3d s;
  double yaw = 0;  // of an upright object
};

/** A residual in its own unit with its derivatives by steps of pose and object. */
struct Row
{
  double r = 0;
  Vector3d d_poseTurn = Vector3d::Zero(), d_poseMove = Vector3d::Zero();
  Vector3d d_objectMove = Vector3d::Zero(), d_objectTurn = Vector3d::Zero();
  Vector3d d_logSizes = Vector3d::Zero();
};

/** Half width of an object along n. */
struct Width
{
  Width(const ObjectAt& object, const Vector3d& n, double q)
  {
    const auto support = supportWithDerivatives(object.R.transpose() * n, object.s, q);
    h = support.h;
    gradient = object.R * support.d_n;
    d_logSizes = support.d_s.cwiseProduct(object.s);
  }
  double h;
  Vector3d gradient;  // dh/dn, in the map
  Vector3d d_logSizes;
};

/** The measurement as seen from one pose of the robot. */
class SeenView
{
 public:
  SeenView(const RobotView& view, const PoseAt& pose, ObjectFreedom freedom) :
      view_(view), pose_(pose), upright_(freedom == ObjectFreedom::Upright)
  {
    axes_ = pose.R * view.axes;
    measuredUp_ = axes_.col(2);
    fromRobot_ = pose.R * view.center;
    if (!upright_ || !view.complete) return;
    // The cuboid is turned upright about its centre, as the map does it.
    const Vector3d u = axes_.col(0);
    const double horizontal2 = u.head<2>().squaredNorm();
    yaw_ = std::atan2(u.y(), u.x());
    d_yaw_ = Vector3d(-u.x() * u.z(), -u.y() * u.z(), horizontal2) / horizontal2;
    axes_ = Eigen::AngleAxisd(yaw_, Vector3d::UnitZ()).toRotationMatrix();
  }

  Row face(std::size_t f, const ObjectAt& object) const
  {
    const auto axis = static_cast<Eigen::Index>(f / 2);
    const Vector3d n = (f % 2 == 0 ? 1.0 : -1.0) * axes_.col(axis);
    const Width width(object, n, view_.faceExponent);
    const Vector3d toCenter = pose_.t + fromRobot_ - object.t;
    Row row;
    row.r = n.dot(toCenter) + view_.halfSizes[axis] - width.h;
    row.d_poseTurn = perPoseTurn(n.cross(toCenter - width.gradient)) + fromRobot_.cross(n);
    row.d_poseMove = n;
    row.d_objectMove = -n;
    row.d_objectTurn = n.cross(width.gradient);
    row.d_logSizes = -width.d_logSizes;
    return row;
  }

  Row yaw(const ObjectAt& object) const
  {
    Row row;
    row.r = object.yaw - nearestEquivalentYaw(yaw_, object.yaw);
    row.d_poseTurn = -d_yaw_;
    row.d_objectTurn = Vector3d::UnitZ();
    return row;
  }

  /** What is up in the measurement against what is up in the map, along x or y. */
  Row tilt(int axis) const
  {
    Row row;
    row.r = measuredUp_[axis];
    row.d_poseTurn = measuredUp_.cross(Vector3d::Unit(axis));
    return row;
  }

  /** Turn of a free object from the measurement, about one axis of the cuboid. */
  Row turn(int axis, const ObjectAt& object) const
  {
    const Matrix3d measured = axes_ * symmetricRotationDistance(object.R, axes_).relabeling;
    const Vector3d e =
        rotationVectorOf(Eigen::Quaterniond(Matrix3d(object.R * measured.transpose())));
    const Vector3d a = axes_.col(axis);
    Row row;
    row.r = a.dot(e);
    row.d_objectTurn = inverseLeftJacobian(e).transpose() * a;
    row.d_poseTurn = -inverseLeftJacobian(-e).transpose() * a + a.cross(e);
    return row;
  }

  Row edge(const RobotView::Edge& e, const ObjectAt& object, double q) const
  {
    const Vector3d n = pose_.R * e.normal, camera = pose_.R * view_.camera;
    const Width width(object, n, q);
    const Vector3d toObject = object.t - pose_.t - camera;
    Row row;
    row.r = n.dot(toObject) - width.h;
    row.d_poseTurn = n.cross(toObject - width.gradient + camera);
    row.d_poseMove = -n;
    row.d_objectMove = n;
    row.d_objectTurn = n.cross(width.gradient);
    row.d_logSizes = -width.d_logSizes;
    return row;
  }

  /** Coordinate i of the whitened seed. */
  Row seed(int i, const ObjectAt& object) const
  {
    const Vector3d m = pose_.R * view_.seedWhitening.row(i).transpose();
    const Vector3d toObject = object.t - pose_.t;
    Row row;
    row.r = m.dot(toObject - fromRobot_);
    row.d_poseTurn = m.cross(toObject);
    row.d_poseMove = -m;
    row.d_objectMove = m;
    return row;
  }

 private:
  /** By a turn of the measured normals -> by a turn of the pose. */
  Vector3d perPoseTurn(const Vector3d& perNormalTurn) const
  {
    return upright_ ? Vector3d(d_yaw_ * perNormalTurn.z()) : perNormalTurn;
  }

  const RobotView& view_;
  const PoseAt& pose_;
  bool upright_;
  Matrix3d axes_;        // of the cuboid, in the map
  Vector3d measuredUp_;  // its z axis before it was turned upright
  Vector3d fromRobot_;   // robot to the measured centre
  double yaw_ = 0;
  Vector3d d_yaw_ = Vector3d::Zero();  // by a turn of the pose
};

/** Puts rows into the arrays of Ceres. */
class RowWriter
{
 public:
  RowWriter(
      const PoseAt& pose,
      const double* object,
      ObjectFreedom freedom,
      double* residuals,
      double** jacobians) :
      residuals_(residuals), freedom_(freedom)
  {
    if (!jacobians) return;
    poseJacobian_ = jacobians[0];
    objectJacobian_ = jacobians[1];
    poseTurn_ = rotationStepPerQuaternion(pose.q);
    if (freedom == ObjectFreedom::Free)
      objectTurn_ = rotationStepPerQuaternion(Eigen::Map<const Eigen::Quaterniond>(object + 3));
  }

  /** \param robust The row's residual in sigmas under its kernel. */
  void add(const Row& row, double sigma, const RobustRow& robust)
  {
    residuals_[index_] = robust.value;
    const double slope = robust.slope / sigma;
    if (poseJacobian_)
    {
      Eigen::Map<Eigen::Matrix<double, 1, 7>> J(poseJacobian_ + 7 * index_);
      J << slope * row.d_poseTurn.transpose() * poseTurn_, slope * row.d_poseMove.transpose();
    }
    if (objectJacobian_) addObject(row, slope);
    ++index_;
  }

  void addZero() { add(Row(), 1, {0, 1}); }

 private:
  void addObject(const Row& row, double slope)
  {
    if (freedom_ == ObjectFreedom::Upright)
    {
      Eigen::Map<Eigen::Matrix<double, 1, 7>> J(objectJacobian_ + 7 * index_);
      J << slope * row.d_objectMove.transpose(), slope * row.d_objectTurn.z(),
          slope * row.d_logSizes.transpose();
      return;
    }
    Eigen::Map<Eigen::Matrix<double, 1, 10>> J(objectJacobian_ + 10 * index_);
    J << slope * row.d_objectMove.transpose(), slope * row.d_objectTurn.transpose() * objectTurn_,
        slope * row.d_logSizes.transpose();
  }

  double* residuals_;
  ObjectFreedom freedom_;
  double *poseJacobian_ = nullptr, *objectJacobian_ = nullptr;
  Eigen::Matrix<double, 3, 4> poseTurn_, objectTurn_;
  std::ptrdiff_t index_ = 0;
};

class ViewFactor : public ceres::CostFunction
{
 public:
  ViewFactor(const RobotView& view, double shapeExponent, double huber, ObjectFreedom freedom) :
      view_(view), shapeExponent_(shapeExponent), huber_(huber), freedom_(freedom)
  {
    for (std::size_t f = 0; view.complete && f < kFaces; ++f)
      if (view.faces[f].kind != FaceKind::Unknown) faces_.push_back(f);
    const bool upright = freedom == ObjectFreedom::Upright;
    anglesOfFree_ = !view.complete || upright || view.tiltSigma <= 0 ? 0 : view.yawDefined ? 3 : 2;
    usesYaw_ = view.complete && view.yawDefined && upright;
    usesTilt_ = view.complete && view.tiltSigma > 0 && upright;
    const std::size_t rows = faces_.size() + view.edges.size() + (view.hasSeed ? 3 : 0) +
                             (usesYaw_ ? 1 : 0) + (usesTilt_ ? 2 : 0) +
                             static_cast<std::size_t>(anglesOfFree_);
    set_num_residuals(static_cast<int>(rows));
    *mutable_parameter_block_sizes() = {7, blockSize(freedom)};
  }

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override
  {
    const PoseAt pose(blocks[0]);
    const ObjectAt object(blocks[1], freedom_);
    const SeenView seen(view_, pose, freedom_);
    RowWriter out(pose, blocks[1], freedom_, residuals, jacobians);
    const auto add = [&](const Row& row, double sigma)
    { out.add(row, sigma, huberRow(row.r / sigma, huber_, view_.weight)); };

    for (const std::size_t f : faces_)
    {
      const Row row = seen.face(f, object);
      const double sigma = view_.faces[f].sigma;
      if (view_.faces[f].kind != FaceKind::AtLeast)
        add(row, sigma);
      else if (row.r <= 0)
        out.addZero();  // large enough: nothing to say
      else
        out.add(row, sigma, cauchyRow(row.r / sigma, huber_, view_.weight));
    }
    if (usesYaw_) add(seen.yaw(object), view_.yawSigma);
    for (int i = 0; usesTilt_ && i < 2; ++i) add(seen.tilt(i), view_.tiltSigma);
    for (int i = 0; i < anglesOfFree_; ++i)
      add(seen.turn(i, object), i < 2 ? view_.tiltSigma : view_.yawSigma);
    for (const auto& edge : view_.edges) add(seen.edge(edge, object, shapeExponent_), edge.sigma);
    for (int i = 0; view_.hasSeed && i < 3; ++i) add(seen.seed(i, object), 1.0);
    return true;
  }

 private:
  RobotView view_;
  double shapeExponent_, huber_;
  ObjectFreedom freedom_;
  std::vector<std::size_t> faces_;
  int anglesOfFree_ = 0;
  bool usesYaw_ = false, usesTilt_ = false;
};

}  // namespace

Factor createViewFactor(
    const RobotView& view, double shapeExponent, double huber, ObjectFreedom freedom)
{
  return std::make_unique<ViewFactor>(view, shapeExponent, huber, freedom);
}

}  // namespace quadmap
