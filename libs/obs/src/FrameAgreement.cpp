#include "quadmap/obs/FrameAgreement.h"

#include <mrpt/core/format.h>
#include <mrpt/math/CMatrixFixed.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

namespace quadmap
{
namespace
{
/** Images without distortion are those of any model whose coefficients are 0. */
bool sameDistortion(const mrpt::img::TCamera& a, const mrpt::img::TCamera& b)
{
  constexpr double kSameCoefficient = 1e-6;  // [-]
  const auto isDistorted = [](const mrpt::img::TCamera& c)
  { return c.distortion != mrpt::img::DistortionModel::none; };
  bool anyDistortion = false;
  for (std::size_t i = 0; i < a.dist.size(); ++i)
  {
    const double ofA = isDistorted(a) ? a.dist[i] : 0, ofB = isDistorted(b) ? b.dist[i] : 0;
    if (!(std::abs(ofA - ofB) < kSameCoefficient)) return false;
    anyDistortion = anyDistortion || std::abs(ofA) >= kSameCoefficient;
  }
  return !anyDistortion || a.distortion == b.distortion;
}

}  // namespace

bool sameCalibration(const mrpt::img::TCamera& a, const mrpt::img::TCamera& b)
{
  constexpr double kSamePixel = 1e-3;  // [px]
  const Eigen::Matrix3d off = a.intrinsicParams.asEigen() - b.intrinsicParams.asEigen();
  return off.allFinite() && off.cwiseAbs().maxCoeff() < kSamePixel;
}

void requireCalibration(const mrpt::img::TCamera& camera, const std::string& whose)
{
  const bool usable = std::isfinite(camera.fx()) && std::isfinite(camera.fy()) &&
                      std::isfinite(camera.cx()) && std::isfinite(camera.cy()) &&
                      std::abs(camera.fx()) > 1 && std::abs(camera.fy()) > 1 && camera.ncols > 0 &&
                      camera.nrows > 0;
  if (!usable)
    throw std::runtime_error(
        whose + mrpt::format(
                    " has no usable calibration (fx %g fy %g cx %g cy %g, image of %ux%u)",
                    camera.fx(), camera.fy(), camera.cx(), camera.cy(), camera.ncols,
                    camera.nrows));
}

std::optional<std::string> mismatch(
    const CObservationObjects& boxes, const mrpt::obs::CObservation3DRangeScan& scan)
{
  const auto &a = boxes.cameraParams, &b = scan.cameraParams;
  if (a.ncols != b.ncols || a.nrows != b.nrows)
    return mrpt::format(
        "its boxes are of a %ux%u image, the scan has %ux%u", a.ncols, a.nrows, b.ncols, b.nrows);
  if (!sameCalibration(a, b))
    return mrpt::format(
        "its boxes have another calibration (fx %g fy %g cx %g cy %g) than the scan (fx %g fy %g "
        "cx %g cy %g)",
        a.fx(), a.fy(), a.cx(), a.cy(), b.fx(), b.fy(), b.cx(), b.cy());
  if (!sameDistortion(a, b))
    return "its boxes are of an image with another distortion than the scan's";
  constexpr double kSamePose = 1e-6;  // [m] and [-]
  const auto A = boxes.sensorPose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
  const auto B = scan.sensorPose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
  if (!((A.asEigen() - B.asEigen()).cwiseAbs().maxCoeff() < kSamePose))
    return "its boxes have another sensorPose than the scan";
  return std::nullopt;
}

}  // namespace quadmap
