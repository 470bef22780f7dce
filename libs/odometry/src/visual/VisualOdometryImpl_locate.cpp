#include <algorithm>
#include <cmath>

#include "VisualOdometryImpl.h"

namespace quadmap
{
using Eigen::Isometry3d;

/** The pose by constant velocity, for a short time after the last image. */
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

/** The motion by descriptors. It is rough at first, and flow that starts from it makes it precise.
 * Where flow finds too little, descriptors near the expected places do. */
std::optional<MotionEstimate> VisualOdometry::Impl::byDescriptors(
    const VisualImage& image, std::optional<Descriptors>& found, double time)
{
  constexpr int kMinRoughMatches = 10;  // fewer may agree by chance
  constexpr int kTries = 2000;          // enough when three of four matches are wrong
  constexpr double kSigmaFactor = 2;    // error of a match / error of a followed corner
  constexpr double kShare = 0.3;        // of minInlierShare, as descriptors err more often
  if (!keyframe->descriptors) keyframe->descriptors = describe(*keyframe->image);
  if (!found) found = describe(image);
  auto correspondences = matchDescriptors(*keyframe->image, *keyframe->descriptors, image, *found);
  const auto T = estimator.consensus(correspondences, image.camera(), kMinRoughMatches, kTries);
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
  constexpr double kMinSurfaceShare = 0.4;  // the rest may be people and doors that move
  return estimate.inliers >= options.minInliers && estimate.inlierShare() >= minShare &&
         isPlausible(estimate, time) &&
         (estimate.overlap < kEnoughOverlap || estimate.surfaceShare >= kMinSurfaceShare);
}

/** Whether the motion is known well enough, and is no faster than people move. */
bool VisualOdometry::Impl::isPlausible(const MotionEstimate& estimate, double time) const
{
  constexpr double kSlack = 0.03;       // errors of both ends [m]
  constexpr double kAngleSlack = 0.03;  // [rad]
  const double dt = time - last->time;
  const Isometry3d T_last_image =
      last->T_map_optical.inverse() * keyframe->T_map_optical * estimate.T_to_from.inverse();
  return estimate.sigmaPosition() <= options.maxSigmaPosition &&
         estimate.sigmaAngle() <= options.maxSigmaAngle &&
         T_last_image.translation().norm() <= kSlack + options.maxSpeed * dt &&
         angleOf(T_last_image) <= std::min(M_PI, kAngleSlack + options.maxTurnRate * dt);
}

}  // namespace quadmap
