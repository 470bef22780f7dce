#include "quadmap/slam/visual/VisualOdometry.h"

#include <mrpt/core/format.h>

#include <cmath>
#include <utility>

#include "Correspondences.h"
#include "MotionEstimator.h"
#include "StepCovariance.h"
#include "VisualImage.h"

namespace quadmap
{
using Eigen::Isometry3d;
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
/** An image that others are compared with. */
struct Reference
{
  std::shared_ptr<const VisualImage> image;
  Isometry3d T_map_optical;
  Corners corners;
  std::vector<SurfaceSample> surface;
  std::optional<Descriptors> descriptors;  // made when needed

  Reference(
      std::shared_ptr<const VisualImage> from,
      const Isometry3d& pose,
      const VisualOdometryOptions& options) :
      image(std::move(from)),
      T_map_optical(pose),
      corners(findCorners(*image, options)),
      surface(sampleSurface(*image))
  {
  }
};

/** The latest image with a pose. */
struct LastImage
{
  std::shared_ptr<const VisualImage> image;
  Isometry3d T_map_optical;
  double time = 0;                       // [s]
  Matrix6 covariance = Matrix6::Zero();  // to its keyframe, in the map
  Vector6 velocity = Vector6::Zero();    // in the optical frame [m/s], [rad/s]
};

}  // namespace

struct VisualOdometry::Impl
{
  Impl(const VisualOdometryOptions& o, const CPose3D& T_map_first) :
      options(o), estimator(options), T_map_robot(isometryOf(T_map_first))
  {
  }

  const VisualOdometryOptions options;
  const MotionEstimator estimator;
  Isometry3d T_map_robot;  // of the last image with a pose
  std::optional<Reference> keyframe;
  std::optional<LastImage> last;
  std::optional<Isometry3d> T_map_marked;  // Robot at the last takeStep()
  StepCovariance uncertainty;
  VisualOdometryCounts counts;
  std::vector<std::string> warnings;
  std::size_t failedInARow = 0;

  bool add(const mrpt::obs::CObservation3DRangeScan& scan);
  std::optional<MotionEstimate> locate(
      const std::shared_ptr<const VisualImage>& image, double time);
  std::optional<MotionEstimate> byFlow(
      const VisualImage& image, double time, const Isometry3d& T_image_key);
  std::optional<MotionEstimate> byDescriptors(
      const VisualImage& image, std::optional<Descriptors>& found, double time);
  bool isCredible(const MotionEstimate& estimate, double minShare, double time) const;
  bool isPlausible(const MotionEstimate& estimate, double time) const;
  Isometry3d predicted(double time) const;
  bool canStart(const Reference& reference) const;
  bool start(const std::shared_ptr<const VisualImage>& image, double time);
  void accept(
      const std::shared_ptr<const VisualImage>& image, double time, const MotionEstimate& estimate);
  bool needsKeyframe(const MotionEstimate& estimate) const;
  void makeKeyframe();
  void fail(double time);
};

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
  constexpr std::size_t kMinFailures = 2;  // before a new start: images may be a second apart
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

/** A constant velocity, for as long as it can be believed. */
Isometry3d VisualOdometry::Impl::predicted(double time) const
{
  constexpr double kHorizon = 0.2;  // [s]
  const double dt = time - last->time;
  if (dt > kHorizon) return last->T_map_optical;
  return last->T_map_optical * smallMotion(dt * last->velocity);
}

std::optional<MotionEstimate> VisualOdometry::Impl::locate(
    const std::shared_ptr<const VisualImage>& image, double time)
{
  const Isometry3d T_image_key = predicted(time).inverse() * keyframe->T_map_optical;
  if (auto estimate = byFlow(*image, time, T_image_key))
  {
    ++counts.byFlow;
    return estimate;
  }
  std::optional<Descriptors> descriptors;
  auto estimate = byDescriptors(*image, descriptors, time);
  if (!estimate && last->image != keyframe->image)
  {
    makeKeyframe();
    estimate = byDescriptors(*image, descriptors, time);
  }
  if (estimate) ++counts.byDescriptors;
  return estimate;
}

std::optional<MotionEstimate> VisualOdometry::Impl::byFlow(
    const VisualImage& image, double time, const Isometry3d& T_image_key)
{
  auto correspondences = followCorners(*keyframe->image, keyframe->corners, image, T_image_key);
  constexpr int kTries = 300;
  const int found = static_cast<int>(correspondences.size());
  const auto T = estimator.consensus(correspondences, image.camera(), options.minInliers, kTries);
  if (!T) return std::nullopt;
  auto estimate =
      estimator.refine(correspondences, keyframe->surface, image, *T, options.sigmaPixel);
  if (!estimate) return std::nullopt;
  estimate->found = found;
  if (!isCredible(*estimate, options.minInlierShare, time)) return std::nullopt;
  return estimate;
}

/** Rough by descriptors, then precise by flow from there; where flow finds too little, by what
 * looks alike near the place where it should be. */
std::optional<MotionEstimate> VisualOdometry::Impl::byDescriptors(
    const VisualImage& image, std::optional<Descriptors>& found, double time)
{
  constexpr int kSeed = 10;           // matches that agree by chance are fewer
  constexpr int kTries = 2000;        // finds four good ones among three times as many bad ones
  constexpr double kSigmaFactor = 2;  // of a followed corner's error
  constexpr double kShare = 0.3;      // of the least share of inliers: descriptors err more often
  if (!keyframe->descriptors) keyframe->descriptors = describe(*keyframe->image);
  if (!found) found = describe(image);
  auto correspondences = matchDescriptors(*keyframe->image, *keyframe->descriptors, image, *found);
  const auto T = estimator.consensus(correspondences, image.camera(), kSeed, kTries);
  if (!T) return std::nullopt;
  const double sigmaPixel = kSigmaFactor * options.sigmaPixel;
  auto estimate = estimator.refine(correspondences, keyframe->surface, image, *T, sigmaPixel);
  if (!estimate) return std::nullopt;
  if (const auto precise = byFlow(image, time, estimate->T_to_from)) return precise;
  correspondences = matchDescriptorsNear(
      *keyframe->image, *keyframe->descriptors, image, *found, estimate->T_to_from);
  estimate =
      estimator.refine(correspondences, keyframe->surface, image, estimate->T_to_from, sigmaPixel);
  if (!estimate || !isCredible(*estimate, kShare * options.minInlierShare, time))
    return std::nullopt;
  return estimate;
}

bool VisualOdometry::Impl::isCredible(
    const MotionEstimate& estimate, double minShare, double time) const
{
  constexpr int kEnoughOverlap = 300;       // samples
  constexpr double kMinSurfaceShare = 0.4;  // people move, doors open
  return estimate.inliers >= options.minInliers && estimate.inlierShare() >= minShare &&
         isPlausible(estimate, time) &&
         (estimate.overlap < kEnoughOverlap || estimate.surfaceShare >= kMinSurfaceShare);
}

/** Known well enough, and not farther than anybody moves. */
bool VisualOdometry::Impl::isPlausible(const MotionEstimate& estimate, double time) const
{
  constexpr double kSlack = 0.03;       // [m]: errors of both ends
  constexpr double kAngleSlack = 0.03;  // [rad]
  const double dt = time - last->time;
  const Isometry3d T_last_image =
      last->T_map_optical.inverse() * keyframe->T_map_optical * estimate.T_to_from.inverse();
  return estimate.sigmaPosition() <= options.maxSigmaPosition &&
         estimate.sigmaAngle() <= options.maxSigmaAngle &&
         T_last_image.translation().norm() <= kSlack + options.maxSpeed * dt &&
         angleOf(T_last_image) <= std::min(M_PI, kAngleSlack + options.maxTurnRate * dt);
}

bool VisualOdometry::Impl::canStart(const Reference& reference) const
{
  return static_cast<int>(reference.corners.points.size()) >= 2 * options.minInliers;
}

/** The first image, or the first good one after a gap: the motion in the gap is unknown, so there
 * is none, with an uncertainty that says so. */
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

/** Of the last image with a pose: what could be placed has enough to go by, if only descriptors. */
void VisualOdometry::Impl::makeKeyframe()
{
  keyframe.emplace(last->image, last->T_map_optical, options);
  ++counts.keyframes;
  uncertainty.addKeyframe(last->covariance);
  last->covariance.setZero();
}

}  // namespace quadmap
