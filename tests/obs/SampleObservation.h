#pragma once

#include <cmath>

#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
inline ObjectMask sampleMask()
{
  ObjectMask mask{11, 22, 40, 30, {}};
  for (unsigned y = 0; y < mask.height; ++y)
    for (unsigned x = 0; x < mask.width; ++x)
      mask.pixels.push_back(std::hypot(x - 20.0, y - 15.0) < 12.0 ? 1 : 0);
  return mask;
}

inline ObjectMeasurement completeMeasurement()
{
  ObjectMeasurement m;
  m.kind = MeasurementKind::Complete;
  m.reason = "projected cuboid fits the box";
  m.projectedIoU = 0.83;
  m.depthCoverage = 0.91;
  m.seed_sensor = Eigen::Vector3d(1.9, -0.1, 0.2);
  CompleteMeasurement& c = m.complete.emplace();
  c.object_sensor = Ellipsoid(
      mrpt::poses::CPose3D(2.0, -0.1, 0.3, 0.7, -0.2, 0.1), Eigen::Vector3d(0.3, 0.2, 0.45));
  for (std::size_t i = 0; i < kFaces; ++i)
    c.faces[i] = {static_cast<FaceKind>(i % 4), 0.01 * static_cast<double>(i + 1)};
  c.yawDefined = true;
  c.yawSigma = 0.03;
  c.yawDominance = 0.6;
  auto& edges = m.edges.emplace();
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const double angle = 0.3 + static_cast<double>(i);
    edges[i].plane_sensor.n = Eigen::Vector3d(0.0, std::cos(angle), std::sin(angle));
    edges[i].plane_sensor.d = 0.001 * static_cast<double>(i);
    edges[i].sigmaAngle = 0.004 + 0.001 * static_cast<double>(i);
    edges[i].state = static_cast<EdgeState>(i % 3);
  }
  return m;
}

/** An observation of which every field differs from its default. It has a complete, a partial and a
 * rejected object, and one that perception has not looked at. */
inline CObservationObjects sampleObservation()
{
  CObservationObjects obs;
  obs.timestamp = mrpt::Clock::fromDouble(1341845948.747897);
  obs.sensorLabel = "camera";
  obs.sensorPose = mrpt::poses::CPose3D(0.1, 0.2, 1.1, 0.3, -0.2, 0.1);
  obs.cameraParams.ncols = 320;
  obs.cameraParams.nrows = 240;
  obs.cameraParams.setIntrinsicParamsFromValues(262.5, -261.5, 159.5, 119.25);
  obs.cameraParams.setDistortionPlumbBob(0.01, -0.02, 0.003, -0.004, 0.005);
  obs.cameraParams.focalLengthMeters = 0.0021;
  obs.cameraParams.cameraName = "kinect";
  obs.coarseDepth = {
      4, 3, {1.5f, 0, 2.25f, 3, 4, 5, 6, 7, 8, 9, 10, 11}
  };

  obs.objects.resize(4);
  obs.objects[0] = {
      "dining table", 0.875, {10.5, 20.25, 100, 90.75},
        sampleMask(), 7u, {       }
  };
  obs.objects[0].measurement = completeMeasurement();
  obs.objects[1] = {
      "cup", 0.5, {200, 100, 230, 140},
        std::nullopt, std::nullopt, {     }
  };
  obs.objects[1].measurement = completeMeasurement();
  obs.objects[1].measurement.kind = MeasurementKind::Partial;
  obs.objects[1].measurement.complete.reset();
  obs.objects[2] = {
      "chair", 0.25, {0, 0, 319, 239},
        std::nullopt, 0u, {   }
  };
  obs.objects[2].measurement.kind = MeasurementKind::Rejected;
  obs.objects[2].measurement.reason = "box fills the image";
  obs.objects[3].label = "tv";
  return obs;
}

}  // namespace quadmap
