#include "quadmap/obs/FrameAgreement.h"

#include <mrpt/core/format.h>
#include <mrpt/math/CMatrixFixed.h>

#include <Eigen/Dense>

namespace quadmap
{
namespace
{
bool sameCalibration(const mrpt::img::TCamera& a, const mrpt::img::TCamera& b)
{
  constexpr double kSamePixel = 1e-3;  // [px]
  return (a.intrinsicParams.asEigen() - b.intrinsicParams.asEigen()).cwiseAbs().maxCoeff() <
         kSamePixel;
}

}  // namespace

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
  constexpr double kSamePose = 1e-6;  // [m] and [-]
  const auto A = boxes.sensorPose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
  const auto B = scan.sensorPose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
  if (!((A.asEigen() - B.asEigen()).cwiseAbs().maxCoeff() < kSamePose))
    return "its boxes have another sensorPose than the scan";
  return std::nullopt;
}

}  // namespace quadmap
