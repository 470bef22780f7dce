#pragma once

#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "quadmap/estimation/MapObject.h"
#include "quadmap/estimation/Visibility.h"
#include "quadmap/geometry/Projection.h"
#include "quadmap/obs/CObservationObjects.h"

namespace quadmap::testing
{
struct TrueObject
{
  std::string label;
  Ellipsoid object;
};

inline TrueObject cuboid(
    const std::string& label,
    const Eigen::Vector3d& center,
    const Eigen::Vector3d& size,
    double yaw)
{
  return {
      label,
      Ellipsoid(mrpt::poses::CPose3D(center.x(), center.y(), center.z(), yaw, 0, 0), 0.5 * size)};
}

/** What goes wrong between the world and the map. */
struct Disturbances
{
  double faceSigma = 0.008;       // [m]
  double yawSigma = 0.03;         // [rad]
  double poseSigma = 0.014;       // [m], of the pose the observation is inserted at
  double poseAngleSigma = 0.014;  // [rad]
  double boxSigma = 3;            // [px]
  double missProbability = 0;
  double flipProbability = 0;  // the label becomes `flipLabel`
  std::string flipLabel = "bed";
  double partialProbability = 0;  // only box edges and a seed
  double wreckProbability = 0;    // the cuboid is 1.8 times too large and shifted
};

/** Measurements of cuboids as perception would make them, written independently of it: the faces
 * towards the camera and the top are measured, the bottom is given by the support, the rest are
 * lower bounds somewhere inside the object. */
class SyntheticCamera
{
 public:
  explicit SyntheticCamera(unsigned seed) : random_(seed) {}

  Disturbances disturbances;
  PinholeCamera camera{525, 525, 319.5, 239.5, 640, 480};

  /** x forward, looking from `eye` to `target`. */
  static mrpt::poses::CPose3D lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target)
  {
    const Eigen::Vector3d d = target - eye;
    return {
        eye.x(), eye.y(), eye.z(), std::atan2(d.y(), d.x()), std::atan2(-d.z(), d.head<2>().norm()),
        0};
  }

  /** Takes no image where it would take so many, at ten a second. */
  void wait(int images) { frame_ += images; }

  /** The pose with the noise of a motion-capture system or an odometry. */
  mrpt::poses::CPose3D disturbed(const mrpt::poses::CPose3D& T_map_sensor)
  {
    const Eigen::Vector3d moved = gauss3(disturbances.poseSigma);
    const Eigen::Vector3d turned = gauss3(disturbances.poseAngleSigma);
    return mrpt::poses::CPose3D(moved.x(), moved.y(), moved.z(), 0, 0, 0) + T_map_sensor +
           mrpt::poses::CPose3D(0, 0, 0, turned.x(), turned.y(), turned.z());
  }

  CObservationObjects observe(
      const mrpt::poses::CPose3D& T_map_sensor, const std::vector<TrueObject>& world)
  {
    CObservationObjects obs;
    obs.sensorLabel = "camera";
    obs.timestamp = mrpt::Clock::fromDouble(1000.0 + 0.1 * frame_++);
    obs.cameraParams.ncols = camera.width;
    obs.cameraParams.nrows = camera.height;
    obs.cameraParams.setIntrinsicParamsFromValues(camera.fx, camera.fy, camera.cx, camera.cy);
    obs.coarseDepth.columns = 32;
    obs.coarseDepth.rows = 24;
    obs.coarseDepth.depth.assign(32 * 24, 8.0f);  // a far wall
    for (const auto& truth : world)
      if (auto seen = observeOne(T_map_sensor, truth)) obs.objects.push_back(*seen);
    return obs;
  }

  double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  double gauss(double sigma) { return std::normal_distribution<double>(0, sigma)(random_); }

  /** Drawn one after the other: compilers evaluate arguments in orders of their own. */
  Eigen::Vector3d gauss3(double sigma)
  {
    Eigen::Vector3d out;
    for (double& value : out) value = gauss(sigma);
    return out;
  }

 private:
  std::mt19937 random_;
  int frame_ = 0;

  std::optional<DetectedObject> observeOne(
      const mrpt::poses::CPose3D& T_map_sensor, const TrueObject& truth)
  {
    const Ellipsoid object_optical = truth.object.transformed(-(T_map_sensor + T_sensor_optical()));
    const auto box = projectCuboidBox(camera, object_optical);
    if (!box || object_optical.center().z() < 0.4) return {};
    const ImageBox inside = box->clipped(camera.width, camera.height);
    // It sees all that the map expects it to see: what it misses is up to the disturbances.
    const double leastInside = ExistenceOptions().visibleShare;
    if (inside.area() < leastInside * box->area() || inside.area() < 100) return {};
    if (uniform() < disturbances.missProbability) return {};

    DetectedObject d;
    d.label = uniform() < disturbances.flipProbability ? disturbances.flipLabel : truth.label;
    d.score = 0.5 + 0.5 * uniform();
    const double s = disturbances.boxSigma;
    d.box = {
        inside.x1 + gauss(s), inside.y1 + gauss(s), inside.x2 + gauss(s), inside.y2 + gauss(s)};
    addEdges(d);
    addSeed(T_map_sensor, truth.object, d.measurement);
    if (uniform() < disturbances.partialProbability)
      d.measurement.kind = MeasurementKind::Partial;
    else
      addCuboid(T_map_sensor, truth.object, d.measurement);
    return d;
  }

  void addEdges(DetectedObject& d)
  {
    std::array<EdgeMeasurement, 4> edges;
    const auto planes = boxEdgePlanes(camera, d.box);
    for (std::size_t i = 0; i < 4; ++i)
    {
      edges[i].plane_sensor = planes[i].transformed(T_sensor_optical());
      edges[i].sigmaAngle = std::max(disturbances.boxSigma, 1.0) / camera.fx;
    }
    const double margin = 30;
    if (d.box.x1 < margin) edges[0].state = EdgeState::NearImageBorder;
    if (d.box.y1 < margin) edges[1].state = EdgeState::NearImageBorder;
    if (d.box.x2 > camera.width - margin) edges[2].state = EdgeState::NearImageBorder;
    if (d.box.y2 > camera.height - margin) edges[3].state = EdgeState::NearImageBorder;
    d.measurement.edges = edges;
  }

  static Eigen::Vector3d inSensor(
      const mrpt::poses::CPose3D& T_map_sensor, const Eigen::Vector3d& p_map)
  {
    Eigen::Vector3d p;
    T_map_sensor.inverseComposePoint(p_map.x(), p_map.y(), p_map.z(), p.x(), p.y(), p.z());
    return p;
  }

  static void addSeed(
      const mrpt::poses::CPose3D& T_map_sensor, const Ellipsoid& object, ObjectMeasurement& m)
  {
    const Eigen::Vector3d c = inSensor(T_map_sensor, object.center());
    m.seed_sensor = c - 0.6 * object.semiAxes().head<2>().minCoeff() * c.normalized();
  }

  void addCuboid(
      const mrpt::poses::CPose3D& T_map_sensor, const Ellipsoid& object, ObjectMeasurement& m)
  {
    const Eigen::Vector3d eye_obj =
        object.rotation().transpose() *
        (Eigen::Vector3d(T_map_sensor.x(), T_map_sensor.y(), T_map_sensor.z()) - object.center());
    CompleteMeasurement c;
    Eigen::Vector3d lower = -object.semiAxes(), upper = object.semiAxes();
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side)
      {
        const double sign = side == 0 ? 1 : -1;
        auto& face = c.faces[static_cast<std::size_t>(2 * axis + side)];
        double& bound = side == 0 ? upper[axis] : lower[axis];
        face.sigma = disturbances.faceSigma;
        const bool faced = sign * eye_obj[axis] > object.semiAxes()[axis];
        const bool bottom = axis == 2 && side == 1;
        face.kind = bottom ? FaceKind::Support : faced ? FaceKind::Measured : FaceKind::AtLeast;
        if (isEqualityKind(face.kind))
          bound += gauss(disturbances.faceSigma);
        else
          bound -= sign * uniform() * 0.4 * object.semiAxes()[axis];
      }
    const double turn = gauss(disturbances.yawSigma);
    c.yawDefined = true;
    c.yawSigma = std::max(disturbances.yawSigma, 0.01);
    c.yawDominance = 0.6;
    Eigen::Vector3d center = 0.5 * (upper + lower), half = 0.5 * (upper - lower);
    if (uniform() < disturbances.wreckProbability)
    {
      const double x = gauss(1), y = gauss(1);
      center += 0.6 * half.norm() * Eigen::Vector3d(x, y, 0.2).normalized();
      half *= 1.8;
    }
    // Perception numbers the axes as it likes.
    const int quarters = static_cast<int>(4 * uniform());
    std::array<FaceMeasurement, kFaces> faces = c.faces;
    static constexpr std::array<std::size_t, 4> kAround{0, 2, 1, 3};
    for (std::size_t i = 0; i < 4; ++i)
      faces[kAround[i]] = c.faces[kAround[(i + static_cast<std::size_t>(quarters)) % 4]];
    c.faces = faces;
    if (quarters % 2 == 1) std::swap(half.x(), half.y());
    const mrpt::poses::CPose3D T_obj_measured(
        center.x(), center.y(), center.z(), turn + quarters * M_PI / 2, 0, 0);
    const Ellipsoid measured(object.pose() + T_obj_measured, half);
    c.object_sensor = measured.transformed(-T_map_sensor);
    m.kind = MeasurementKind::Complete;
    m.complete = c;
    m.projectedIoU = 0.9;
    m.depthCoverage = 0.9;
  }

  static bool isEqualityKind(FaceKind kind)
  {
    return kind == FaceKind::Measured || kind == FaceKind::Support;
  }
};

}  // namespace quadmap::testing
