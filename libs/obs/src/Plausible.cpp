#include "quadmap/obs/Plausible.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>

#include "quadmap/geometry/PosePosition.h"

namespace quadmap
{
namespace
{
// In image widths
constexpr double kShortestFocal = 1e-3, kLongestFocal = 1000, kFarthestCentre = 100;

bool isWithin(double value, double least, double most) { return value >= least && value <= most; }
}  // namespace

bool isRotation(const Eigen::Matrix3d& R)
{
  constexpr double kRounding = 1e-2;
  return R.allFinite() && R.determinant() > 0 &&
         (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < kRounding;
}

std::optional<std::string> whyNoPose(const mrpt::poses::CPose3D& pose, double farthest)
{
  const Eigen::Matrix3d R = pose.getRotationMatrix().asEigen();
  const Eigen::Vector3d t = positionOf(pose);
  if (!R.allFinite() || !t.allFinite()) return "has numbers that are not finite";
  if (const double distance = t.stableNorm(); !(distance <= farthest))
    return mrpt::format("is %g m away, which is absurd", distance);
  if (!isRotation(R))
    return "has no rotation (a zero quaternion, or a matrix that scales or mirrors)";
  return std::nullopt;
}

std::optional<std::string> whyNoUnitQuaternion(const Eigen::Quaterniond& q)
{
  constexpr double kRounding = 0.05;              // of two decimals it is 0.01 at most
  const double length = q.coeffs().stableNorm();  // the square of 1e300 would be infinite
  if (length == 0) return "is zero";
  if (!(std::abs(length - 1) <= kRounding))
    return mrpt::format("has the length %.3g instead of 1", length);
  return std::nullopt;
}

std::optional<std::string> whyNoSize(const Eigen::Vector3d& size)
{
  for (const double side : {size.x(), size.y(), size.z()})
    if (!isWithin(side, kSmallestSize, kLargestSize))
      return mrpt::format("is %g m, and not in [%g, %g] m", side, kSmallestSize, kLargestSize);
  return std::nullopt;
}

std::optional<std::string> whyNoObject(const Ellipsoid& object)
{
  if (const auto why = whyNoPose(object.pose())) return why;
  if (const auto why = whyNoSize(2 * object.semiAxes())) return "has a size that " + *why;
  return std::nullopt;
}

std::optional<std::string> whyNoCalibration(const mrpt::img::TCamera& camera)
{
  const auto& K = camera.intrinsicParams;
  if (!K.asEigen().allFinite() || K(0, 0) == 0 || K(1, 1) == 0)
    return mrpt::format("has no camera calibration (fx=%g, fy=%g)", K(0, 0), K(1, 1));
  const double width = camera.ncols;
  for (int i = 0; i < 2; ++i)
    if (!isWithin(std::abs(K(i, i)), kShortestFocal * width, kLongestFocal * width) ||
        !(std::abs(K(i, 2)) <= kFarthestCentre * width))
      return mrpt::format(
          "has an absurd calibration (focal length %g, centre %g in images %u px wide)", K(i, i),
          K(i, 2), camera.ncols);
  const bool isDistorted = camera.distortion != mrpt::img::DistortionModel::none;
  for (const double k : camera.dist)
    if (isDistorted && !(std::abs(k) <= kLargestCoefficient))
      return mrpt::format("has an absurd calibration (a coefficient of distortion is %g)", k);
  return std::nullopt;
}

}  // namespace quadmap
