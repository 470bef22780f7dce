#include "quadmap/simulator/Simulator.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "camera/MotionBlur.h"
#include "detector/DetectorMask.h"
#include "noise/DepthNoise.h"
#include "noise/SimulatedOdometry.h"
#include "quadmap/simulator/CameraPath.h"

namespace quadmap::simulator
{
namespace
{
constexpr double kDepthUnit =
    1.0 / 5000;  // unit of the stored 16-bit depth, as TUM's: up to 13.1 m [m]

/** \param error Relative error of the focal length. */
mrpt::img::TCamera calibrationOf(const PinholeCamera& camera, double error)
{
  mrpt::img::TCamera calibration;
  calibration.ncols = camera.width;
  calibration.nrows = camera.height;
  calibration.setIntrinsicParamsFromValues(
      camera.fx * (1 + error), camera.fy * (1 + error), camera.cx, camera.cy);
  return calibration;
}

/** The colour image, with noise. */
mrpt::img::CImage colorImage(const RenderedFrame& frame, double sigma, RandomStream random)
{
  mrpt::img::CImage image(frame.camera.width, frame.camera.height, mrpt::img::CH_RGB);
  const std::uint8_t* source = frame.rgb.data();
  for (unsigned v = 0; v < frame.camera.height; ++v)
  {
    std::uint8_t* line = image.ptrLine<std::uint8_t>(v);
    for (unsigned u = 0; u < frame.camera.width; ++u, source += 3, line += 3)
      for (unsigned c = 0; c < 3; ++c)
      {
        const double value = source[c] + (sigma > 0 ? sigma * random.gaussian() : 0.0);
        line[2 - c] = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
      }
  }
  return image;
}

void storeDepth(const std::vector<float>& depth, mrpt::obs::CObservation3DRangeScan& scan)
{
  const auto rows = static_cast<int>(scan.cameraParams.nrows);
  const auto columns = static_cast<int>(scan.cameraParams.ncols);
  scan.hasRangeImage = true;
  scan.range_is_depth = true;
  scan.rangeUnits = static_cast<float>(kDepthUnit);
  scan.rangeImage_setSize(rows, columns);
  std::size_t i = 0;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c, ++i)
      scan.rangeImage(r, c) =
          static_cast<std::uint16_t>(std::lround(static_cast<double>(depth[i]) / kDepthUnit));
}

}  // namespace

Simulator::Simulator(Scene scene, LabelTable labels, std::uint64_t seed) :
    scene_(std::move(scene)),
    labels_(std::move(labels)),
    seed_(seed),
    cameras_(scene_.options.cameras()),
    shots_(shotsOf(cameras_, scene_.options.trajectory)),
    detector_(scene_, scene_.options.detector, labels_, seed_)
{
  std::vector<double> instants;
  for (const auto& shot : shots_) instants.push_back(shot.instant);
  T_world_robot_ = robotPath(scene_, scene_.options.trajectory, instants);
  T_start_end_ = motionDuringExposure(instants);
  RandomStream random(seed_, Purpose::Odometry, 0);
  odometry_ = driftingOdometry(T_world_robot_, scene_.options.odometry, random);
}

std::vector<mrpt::poses::CPose3D> Simulator::motionDuringExposure(
    const std::vector<double>& instants) const
{
  const auto& trajectory = scene_.options.trajectory;
  std::vector<mrpt::poses::CPose3D> motion;
  const bool any = std::any_of(
      cameras_.begin(), cameras_.end(), [](const CameraOptions& c) { return c.exposure > 0; });
  if (!any) return motion;
  std::vector<double> later;  // one millisecond
  for (const double instant : instants)
    later.push_back(instant + 1e-3 * trajectory.frames / trajectory.duration);
  const auto after = robotPath(scene_, trajectory, later);
  for (std::size_t i = 0; i < instants.size(); ++i)
  {
    const mrpt::poses::CPose3D step = after[i] - T_world_robot_[i];
    const double times = 1e3 * cameras_[shots_[i].camera].exposure;
    motion.emplace_back(
        times * step.x(), times * step.y(), times * step.z(), times * step.yaw(),
        times * step.pitch(), times * step.roll());
  }
  return motion;
}

std::vector<Simulator::Shot> Simulator::shotsOf(
    const std::vector<CameraOptions>& cameras, const TrajectoryOptions& trajectory)
{
  std::vector<Shot> shots;
  for (int frame = 0; frame < trajectory.frames; ++frame)
    for (std::size_t i = 0; i < cameras.size(); ++i)
      shots.push_back({frame + cameras[i].delay * trajectory.frames / trajectory.duration, i});
  std::stable_sort(
      shots.begin(), shots.end(),
      [](const Shot& a, const Shot& b) { return a.instant < b.instant; });
  return shots;
}

const CameraOptions& Simulator::camera(std::size_t frame) const
{
  return cameras_[shots_.at(frame).camera];
}

double Simulator::time(std::size_t frame) const
{
  const auto& trajectory = scene_.options.trajectory;
  return trajectory.startTime + trajectory.duration * shots_.at(frame).instant / trajectory.frames;
}

SimulatedFrame Simulator::frame(std::size_t index) const
{
  const CameraOptions& by = camera(index);
  RenderedFrame rendered = RayCaster(scene_, by.pinhole())
                               .render(
                                   T_world_robot_[index] + by.T_robot_camera(),
                                   time(index) - scene_.options.trajectory.startTime);
  if (by.exposure > 0)
    blurByMotion(rendered, (T_start_end_[index] + by.T_robot_camera()) - by.T_robot_camera());
  SimulatedFrame result;
  result.scan = scanOf(rendered, index);
  result.visible = visibleObjects(scene_, rendered, scene_.options.detector);

  RandomStream random(seed_, Purpose::Detector, index);
  result.objects = CObservationObjects::Create();
  result.objects->sensorLabel = result.scan->sensorLabel;
  result.objects->timestamp = result.scan->timestamp;
  result.objects->cameraParams = result.scan->cameraParams;
  result.objects->sensorPose = result.scan->sensorPose;
  Detections found = detector_.detect(result.visible, rendered.camera, random, rendered.blur);
  const DetectorOptions& detector = scene_.options.detector;
  if (detector.output != DetectorOutput::Boxes)
  {
    RandomStream maskRandom(seed_, Purpose::Mask, index);
    addMasks(found, rendered, detector, maskRandom);
  }
  if (labelsPixels(detector.output)) labelPixels(found, scene_, detector.output, *result.scan);
  result.objects->objects = std::move(found.boxes);
  result.truthOfBox = std::move(found.truth);
  return result;
}

mrpt::obs::CObservation3DRangeScan::Ptr Simulator::scanOf(
    const RenderedFrame& rendered, std::size_t index) const
{
  const auto scan = mrpt::obs::CObservation3DRangeScan::Create();
  scan->sensorLabel = camera(index).name;
  scan->sensorPose = camera(index).T_robot_camera();
  scan->timestamp = mrpt::Clock::fromDouble(time(index));
  scan->cameraParams = scan->cameraParamsIntensity =
      calibrationOf(rendered.camera, camera(index).focalError);
  scan->maxRange = static_cast<float>(scene_.options.depthNoise.maxRange);

  RandomStream random(seed_, Purpose::Depth, index);
  storeDepth(noisyDepth(rendered, scene_.options.depthNoise, random), *scan);
  scan->hasIntensityImage = true;
  scan->intensityImage =
      colorImage(rendered, camera(index).colorNoise, RandomStream(seed_, Purpose::Color, index));
  return scan;
}

}  // namespace quadmap::simulator
