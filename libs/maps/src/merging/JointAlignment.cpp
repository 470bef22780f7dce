#include "merging/JointAlignment.h"

#include <cmath>

#include "FreeInformation.h"
#include "quadmap/estimation/AxisRenaming.h"
#include "quadmap/estimation/LabelPrior.h"
#include "quadmap/estimation/NormalEquations.h"
#include "quadmap/estimation/RobustKernel.h"
#include "quadmap/geometry/RotationDistance.h"

namespace quadmap
{
namespace
{
constexpr Eigen::Index kYaw = 3;

using ByPlace = Eigen::Matrix<double, 7, 4>;

/** The information in the turn of the state. */
InformationPrior inTurnOf(const UprightState& state, InformationPrior known)
{
  known.xi += known.L * (state - known.inItsTurn(state));
  return known;
}

/** What is known when the yaw may be any. */
InformationPrior withoutYaw(InformationPrior known)
{
  const double yaw = known.L(kYaw, kYaw);
  if (!(yaw > 0)) return known;
  const UprightState l = known.L.col(kYaw);
  known.xi -= l * (known.xi[kYaw] / yaw);
  known.L -= l * l.transpose() / yaw;
  known.L.row(kYaw).setZero();
  known.L.col(kYaw).setZero();
  known.xi[kYaw] = 0;
  return known;
}

KnownState renamed(const KnownState& known, const AxisRenaming& by)
{
  KnownState out = known;
  out.state = by.state(known.state);
  out.known.L = by.matrix(known.known.L);
  out.known.xi = by.P * known.known.xi + out.known.L * by.c;
  return out;
}

/** Both states of an object with their axes named alike. Where one of them has no heading, the
 * longer axis tells which is which, and its yaw says nothing. */
struct NamedAlike
{
  NamedAlike(const KnownPair& pair, double yaw) : own(pair.own), other(pair.other)
  {
    own.known = inTurnOf(own.state, own.known);
    other.known = inTurnOf(other.state, other.known);
    int turns = quarterTurnsTo(other.state[kYaw] + yaw, own.state[kYaw]);
    const auto longerFirst = [](const UprightState& x) { return x[4] > x[5]; };
    haveHeadings = own.hasHeading && other.hasHeading;
    if (!haveHeadings)
      turns += longerFirst(axisRenaming(turns).state(other.state)) != longerFirst(own.state);
    other = renamed(other, axisRenaming(turns));
    if (haveHeadings) return;
    if (!own.hasHeading) own.known = withoutYaw(own.known);
    if (!other.hasHeading) other.known = withoutYaw(other.known);
  }

  KnownState own, other;
  bool haveHeadings = false;  //!< Both of them
};

/** An object of both maps, in one step of the estimation. */
class JointObject
{
 public:
  JointObject(const KnownPair& pair, double yaw, const EstimatorOptions& options) :
      both_(pair, yaw), label_(pair.label), options_(options), x_(both_.own.state)
  {
  }

  /** doc/mathematics.md, (25.1) and (25.2); its terms of (25.3). */
  void linearise(const ShiftAndYaw& T_own_other)
  {
    const StateShift shift(T_own_other);
    const UprightState y = shift.back(x_);
    const ByPlace J = -shift.D.transpose() * byShiftAndYaw(shift, y);
    const UprightCovariance& L = both_.other.known.L;
    const UprightState g = L * y - both_.other.known.xi;
    NormalEquations prior;
    addLabelPrior(x_, label_, options_, prior);
    prior.H += freeInformation();
    g_ = prior.g + both_.own.known.L * x_ - both_.own.known.xi + shift.D * g;
    inverse_ = (prior.H + both_.own.known.L + shift.D * L * shift.D.transpose()).inverse();
    cross_ = shift.D * L * J;
    // Schur's complement: what the object says of the place.
    ofPlace_ = J.transpose() * L * J - cross_.transpose() * inverse_ * cross_;
    gOfPlace_ = J.transpose() * g - cross_.transpose() * inverse_ * g_;
    distance_ = distanceAt(shift, prior.H);
  }

  /** Moves it to its minimum, given the step of the place. \return The largest change. */
  double follow(const ShiftAndYaw& step)
  {
    const UprightState change = -inverse_ * (g_ + cross_ * step);
    x_ += change;
    return change.cwiseAbs().maxCoeff();
  }

  /** doc/mathematics.md, (25.6). */
  double weight() const { return RobustKernel::cauchy(kObjectKernel).weight(distance_); }
  const Eigen::Matrix4d& ofPlace() const { return ofPlace_; }
  const Eigen::Vector4d& gOfPlace() const { return gOfPlace_; }

  /** The second term of doc/mathematics.md, (25.4), as its shared error. */
  JointEstimate::Object result(
      const StateShift& shift, const Eigen::Matrix4d& placeCovariance) const
  {
    JointEstimate::Object out;
    out.state = x_;
    out.known = both_.own.known;
    const InformationPrior moved = shift.information(both_.other.known);
    out.known.L += moved.L;
    out.known.xi += moved.xi;
    out.known.complete += moved.complete;
    out.known.yawDefined += moved.yawDefined;
    const ByPlace gain = inverse_ * cross_;
    out.sharedError = gain * placeCovariance * gain.transpose();
    out.distance = distance_;
    return out;
  }

 private:
  double distanceAt(const StateShift& shift, const UprightCovariance& prior) const
  {
    UprightState r = both_.own.state - shift.state(both_.other.state);
    if (!both_.haveHeadings) r[kYaw] = 0;
    const UprightCovariance S =
        (both_.own.known.L + prior).inverse() +
        shift.D * (both_.other.known.L + prior).inverse() * shift.D.transpose();
    return std::sqrt(r.dot(S.ldlt().solve(r)));
  }

  NamedAlike both_;
  const LabelProperties& label_;
  const EstimatorOptions& options_;
  UprightState x_;
  UprightState g_ = UprightState::Zero();
  UprightCovariance inverse_ = UprightCovariance::Identity();
  ByPlace cross_ = ByPlace::Zero();
  Eigen::Matrix4d ofPlace_ = Eigen::Matrix4d::Zero();
  Eigen::Vector4d gOfPlace_ = Eigen::Vector4d::Zero();
  double distance_ = 0;
};

}  // namespace

StateShift::StateShift(const ShiftAndYaw& T_own_other)
{
  D.topLeftCorner<3, 3>() =
      Eigen::AngleAxisd(T_own_other[3], Eigen::Vector3d::UnitZ()).toRotationMatrix();
  c.head<4>() = T_own_other;
}

InformationPrior StateShift::information(const InformationPrior& other) const
{
  InformationPrior moved = other;
  moved.L = D * other.L * D.transpose();
  moved.xi = D * other.xi + moved.L * c;
  return moved;
}

Eigen::Matrix<double, 7, 4> byShiftAndYaw(const StateShift& shift, const UprightState& y)
{
  ByPlace J = ByPlace::Zero();
  J.topLeftCorner<4, 4>().setIdentity();
  const Eigen::Vector3d p = shift.D.topLeftCorner<3, 3>() * y.head<3>();
  J(0, 3) = -p.y();
  J(1, 3) = p.x();
  return J;
}

JointEstimate estimateJointly(
    const std::vector<KnownPair>& pairs, const ShiftAndYaw& start, const EstimatorOptions& options)
{
  constexpr int kMaxIterations = 100;
  constexpr double kSmall = 1e-11;  // [m], [rad], [-]
  JointEstimate joint;
  joint.T_own_other = start;
  std::vector<JointObject> objects;
  for (const KnownPair& pair : pairs) objects.emplace_back(pair, start[3], options);
  double change = 1;
  for (int i = 0; i < kMaxIterations && change > kSmall; ++i)
  {
    Eigen::Matrix4d H = Eigen::Matrix4d::Zero();
    Eigen::Vector4d g = Eigen::Vector4d::Zero();
    for (JointObject& object : objects)
    {
      object.linearise(joint.T_own_other);
      H += object.weight() * object.ofPlace();
      g += object.weight() * object.gOfPlace();
    }
    const ShiftAndYaw step = -H.ldlt().solve(g);
    joint.T_own_other += step;
    joint.covariance = H.inverse();
    change = step.cwiseAbs().maxCoeff();
    for (JointObject& object : objects) change = std::max(change, object.follow(step));
  }
  for (const JointObject& object : objects)
    joint.objects.push_back(object.result(StateShift(joint.T_own_other), joint.covariance));
  return joint;
}

}  // namespace quadmap
