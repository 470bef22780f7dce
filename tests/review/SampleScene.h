#pragma once

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <string>

#include "quadmap/review/SceneContent.h"

namespace quadmap::testing
{
inline ObjectRecord recordOf(
    const std::string& id,
    const std::string& label,
    const mrpt::poses::CPose3D& T_map_obj,
    const Eigen::Vector3d& semiAxes)
{
  ObjectRecord record;
  record.id = id;
  record.label = label;
  record.object = Ellipsoid(T_map_obj, semiAxes);
  return record;
}

/** Three objects of different colours, and a walk around them. */
inline SceneContent sampleContent()
{
  SceneContent content;
  content.objects = {
      recordOf("1", "chair", {1.0, 0.5, 0.45, 0.3, 0, 0}, {0.25, 0.25, 0.45}),
      recordOf("2", "couch", {-1.5, 1.0, 0.4, 0.1, 0, 0}, {0.4, 0.9, 0.4}),
      recordOf("3", "refrigerator", {0.5, -1.8, 0.9, -0.5, 0, 0}, {0.3, 0.3, 0.9})};
  content.truth = {recordOf("1", "chair", {1.02, 0.5, 0.45, 0.3, 0, 0}, {0.25, 0.25, 0.45})};
  for (int i = 0; i < 20; ++i)
  {
    const double a = 0.3 * i;
    content.trajectory.emplace_back(0.8 * std::cos(a), 0.8 * std::sin(a), 0.6, a, 0, 0);
    content.odometry.emplace_back(0.9 * std::cos(a), 0.8 * std::sin(a), 0.6, a, 0, 0);
    content.cameras.push_back({content.trajectory.back(), 1.0, 0.8});
  }
  return content;
}

/** A red wall at x = 2 m in front of a camera that looks along x. */
inline mrpt::obs::CObservation3DRangeScan::Ptr scanOfWall()
{
  constexpr int kWidth = 128, kHeight = 96;
  constexpr double kFocal = 120;  // [px]
  auto scan = mrpt::obs::CObservation3DRangeScan::Create();
  scan->sensorLabel = "camera";
  scan->rangeImage_setSize(kHeight, kWidth);
  scan->rangeUnits = 0.001F;
  scan->range_is_depth = true;
  scan->rangeImage.fill(2000);
  scan->hasRangeImage = true;
  scan->intensityImage.resize(kWidth, kHeight, mrpt::img::CH_RGB);
  scan->intensityImage.filledRectangle(0, 0, kWidth, kHeight, mrpt::img::TColor(200, 30, 20));
  scan->hasIntensityImage = true;
  scan->cameraParams.ncols = kWidth;
  scan->cameraParams.nrows = kHeight;
  scan->cameraParams.setIntrinsicParamsFromValues(
      kFocal, kFocal, 0.5 * (kWidth - 1), 0.5 * (kHeight - 1));
  scan->cameraParamsIntensity = scan->cameraParams;
  return scan;
}

inline void addKeyframe(
    mrpt::maps::CSimpleMap& map,
    const mrpt::poses::CPose3D& T_map_robot,
    const mrpt::obs::CObservation3DRangeScan::Ptr& scan)
{
  mrpt::obs::CSensoryFrame frame;
  frame.insert(scan);
  map.insert(mrpt::poses::CPose3DPDFGaussian(T_map_robot), frame);
}

}  // namespace quadmap::testing
