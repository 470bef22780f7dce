#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "../obs/TemporaryFolder.h"
#include "quadmap/simulator/RayCaster.h"
#include "quadmap/simulator/SimulatorOptions.h"

namespace quadmap::simulator
{
/** A room with a wall 3 m ahead of a camera at (0, 0, 1.3) that looks along +x. */
inline const std::string kRoomText =
    "[room]\nsize = 6 6 2.6\nfloor = grey\nwalls = grey\nceiling = grey\n"
    "[material grey]\ncolor = 128 128 128\n"
    "[material screen]\ncolor = 10 10 10\ndepth = no\n"
    "[trajectory]\nframes = 5\nwaypoint1 = 0 0 1.3  2 0 1.3\nwaypoint2 = 0.5 0 1.3  2 0 1.3\n"
    "waypoint3 = 0.5 0.5 1.3  2 0 1.3\nwaypoint4 = 0 0.5 1.3  2 0 1.3\n";

inline Scene sceneFromText(const std::string& text)
{
  const TemporaryFolder folder;
  return readScene(folder.write("scene.ini", text));
}

inline Scene homeScene() { return readScene(findScene("home")); }

/** A camera in the middle of that room that looks along +x. */
inline mrpt::poses::CPose3D lookingAhead() { return {0, 0, 1.3, 0, 0, 0}; }

inline PinholeCamera smallCamera()
{
  CameraOptions options;
  options.resize(160, 120);
  return options.pinhole();
}

/** Whether a point (in `prim`) is inside the solid, by definition and not by the tested code. */
inline bool isInside(const Primitive& primitive, const Eigen::Vector3d& p)
{
  const Eigen::Array3d s = p.array() / primitive.halfSize.array();
  if (primitive.shape == Shape::Ellipsoid) return s.square().sum() <= 1;
  if (primitive.shape == Shape::Box) return s.abs().maxCoeff() <= 1;
  return s.x() * s.x() + s.y() * s.y() <= 1 && std::abs(s.z()) <= 1;
}

/** A random point of the surface, in `prim`. */
inline Eigen::Vector3d surfacePoint(const Primitive& primitive, std::mt19937& random)
{
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::normal_distribution<double> gaussian;
  Eigen::Vector3d s(uniform(random), uniform(random), uniform(random));
  const bool onCap = uniform(random) > 0;
  if (primitive.shape == Shape::Ellipsoid)
    s = Eigen::Vector3d(gaussian(random), gaussian(random), gaussian(random)).normalized();
  else if (primitive.shape == Shape::Box)
    s[std::uniform_int_distribution<int>(0, 2)(random)] = onCap ? 1 : -1;
  else
  {
    const double angle = M_PI * uniform(random);
    const double radius = onCap ? std::sqrt(std::abs(s.x())) : 1;
    const double height = onCap ? (s.z() > 0 ? 1 : -1) : s.z();
    s = Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), height);
  }
  return s.cwiseProduct(primitive.halfSize);
}

inline Eigen::Vector3d transformed(const mrpt::poses::CPose3D& T, const Eigen::Vector3d& p)
{
  Eigen::Vector3d q;
  T.composePoint(p.x(), p.y(), p.z(), q.x(), q.y(), q.z());
  return q;
}

inline Eigen::Vector3d inverted(const mrpt::poses::CPose3D& T, const Eigen::Vector3d& p)
{
  Eigen::Vector3d q;
  T.inverseComposePoint(p.x(), p.y(), p.z(), q.x(), q.y(), q.z());
  return q;
}

/** Mean and standard deviation of some values. */
struct Moments
{
  double mean = 0, deviation = 0;
};

inline Moments momentsOf(const std::vector<double>& values)
{
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  const double n = static_cast<double>(values.size()), mean = sum / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, std::sqrt(squares / (n - 1))};
}

/** A detector without errors. */
inline DetectorOptions faultless()
{
  SimulatorOptions options;
  options.scaleNoise(0);
  return options.detector;
}
}  // namespace quadmap::simulator
