#include "quadmap/odometry/VisualOdometry.h"

#include <mrpt/core/format.h>

#include <cmath>
#include <utility>

#include "VisualOdometryImpl.h"

namespace quadmap
{
using Eigen::Isometry3d;
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

VisualOdometry::VisualOdometry(const VisualOdometryOptions& options, const CPose3D& T_map_first) :
    impl_(std::make_unique<Impl>(options, T_map_first))
{
}

VisualOdometry::~VisualOdometry() = default;

std::optional<CPose3D> VisualOdometry::add(const mrpt::obs::CObservation3DRangeScan& scan)
{
  if (!impl_->add(scan)) return std::nullopt;
  return poseOf(impl_->T_map_robot);
}

std::optional<CPose3DPDFGaussian> VisualOdometry::takeStep()
{
  const Isometry3d T_map_robot = impl_->T_map_robot;
  const Matrix6 inMap = impl_->uncertainty.take();
  const auto from = std::exchange(impl_->T_map_marked, T_map_robot);
  if (!from) return std::nullopt;
  const Matrix6 A = adjoint(from->inverse());
  return gaussianOf(from->inverse() * T_map_robot, A * inMap * A.transpose());
}

const VisualOdometryCounts& VisualOdometry::counts() const { return impl_->counts; }

std::vector<std::string> VisualOdometry::takeWarnings()
{
  return std::exchange(impl_->warnings, {});
}

bool VisualOdometry::Impl::add(const mrpt::obs::CObservation3DRangeScan& scan)
{
  constexpr std::size_t kMinFailures = 2;  // images may be a second apart
  ++counts.frames;
  const double time = mrpt::Clock::toDouble(scan.timestamp);
  const auto image = std::make_shared<const VisualImage>(scan, options);
  bool known = false;
  if (!keyframe)
    known = start(image, time);
  else if (const auto estimate = locate(image, time))
  {
    accept(image, time, *estimate);
    known = true;
  }
  else if (time - last->time > options.maxGap && failedInARow >= kMinFailures)
    known = start(image, time);
  if (!known) return fail(time), false;
  failedInARow = 0;
  T_map_robot = last->T_map_optical * image->T_robot_optical().inverse();
  return true;
}

void VisualOdometry::Impl::fail(double time)
{
  ++counts.failed;
  if (failedInARow++ > 0) return;
  warnings.push_back(mrpt::format(
      "visual odometry lost its way at %.3f s%s", time,
      keyframe ? "" : ": the image shows too little to begin with"));
}

bool VisualOdometry::Impl::canStart(const Reference& reference) const
{
  return static_cast<int>(reference.corners.points.size()) >= 2 * options.minInliers;
}

/** Starts with the first image, or with the first good one after a gap. The motion in the gap is
 * unknown. It is set to none, with a large uncertainty: doc/mathematics.md, (15.10). */
bool VisualOdometry::Impl::start(const std::shared_ptr<const VisualImage>& image, double time)
{
  const Isometry3d T_map_optical = T_map_robot * image->T_robot_optical();
  Reference reference(image, T_map_optical, options);
  if (!canStart(reference)) return false;
  if (last)
  {
    const double gap = time - last->time;
    Matrix6 unknown = Matrix6::Zero();
    unknown.diagonal().head<3>().setConstant(std::pow(options.gapSpeed * gap, 2));
    unknown.diagonal().tail<3>().setConstant(
        std::pow(std::min(M_PI, options.gapTurnRate * gap), 2));
    const Matrix6 A = adjoint(T_map_optical);
    uncertainty.addKeyframe(last->covariance + A * unknown * A.transpose());
    ++counts.gaps;
    warnings.push_back(mrpt::format(
        "visual odometry does not know the motion from %.3f to %.3f s: it goes on as if there were "
        "none",
        last->time, time));
  }
  keyframe.emplace(std::move(reference));
  ++counts.keyframes;
  last = LastImage{image, T_map_optical, time, Matrix6::Zero(), Vector6::Zero()};
  return true;
}

void VisualOdometry::Impl::accept(
    const std::shared_ptr<const VisualImage>& image, double time, const MotionEstimate& estimate)
{
  LastImage next;
  next.image = image;
  next.time = time;
  next.T_map_optical = keyframe->T_map_optical * estimate.T_to_from.inverse();
  const Matrix6 A = adjoint(next.T_map_optical);
  next.covariance = A * estimate.covariance * A.transpose();
  const double dt = time - last->time;
  const Isometry3d moved = last->T_map_optical.inverse() * next.T_map_optical;
  const Eigen::AngleAxisd turn(moved.linear());
  next.velocity << moved.translation() / dt, turn.angle() / dt * turn.axis();
  last = std::move(next);
  uncertainty.setLatest(last->covariance);
  if (needsKeyframe(estimate)) makeKeyframe();
}

bool VisualOdometry::Impl::needsKeyframe(const MotionEstimate& estimate) const
{
  const double corners = static_cast<double>(keyframe->corners.points.size());
  return estimate.T_to_from.translation().norm() > options.keyframeTranslation ||
         angleOf(estimate.T_to_from) > options.keyframeRotation ||
         estimate.inliers < options.keyframeMinShare * corners;
}

/** Makes the last image with a pose the keyframe. An image that got a pose has enough corners or
 * descriptors to find the next one. */
void VisualOdometry::Impl::makeKeyframe()
{
  keyframe.emplace(last->image, last->T_map_optical, options);
  ++counts.keyframes;
  uncertainty.addKeyframe(last->covariance);
  last->covariance.setZero();
}

}  // namespace quadmap
