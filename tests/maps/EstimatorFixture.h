#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "SyntheticScene.h"
#include "quadmap/geometry/Overlap.h"
#include "quadmap/geometry/RotationDistance.h"
#include "quadmap/maps/ObjectEstimator.h"

namespace quadmap::testing
{
inline const PoseNoise kNoise;

inline LabelProperties boxy(const std::string& name)
{
  LabelProperties p;
  p.name = name;
  p.shapeExponent = 1.0;
  p.typicalSize = {0.6, 0.6, 0.6};
  p.sizeSpread = 0.6;
  p.known = true;
  return p;
}

inline const TrueObject kCabinet = cuboid("suitcase", {1.5, 0.4, 0.28}, {0.78, 0.43, 0.56}, 0.3);

/** Seen from all around, 2 m away. */
inline std::vector<ObjectView> viewsAround(
    SyntheticCamera& camera, const TrueObject& truth, int count)
{
  std::vector<ObjectView> views;
  for (int i = 0; i < count; ++i)
  {
    const double angle = 2 * M_PI * i / count;
    const Eigen::Vector3d eye =
        truth.object.center() + Eigen::Vector3d(2 * std::cos(angle), 2 * std::sin(angle), 1.0);
    const auto T_map_sensor = SyntheticCamera::lookAt(eye, truth.object.center());
    const auto obs = camera.observe(T_map_sensor, {truth});
    for (const auto& d : obs.objects)
      if (auto v = viewOf(d, camera.disturbed(T_map_sensor), boxy(truth.label), kNoise))
        views.push_back(*v);
  }
  return views;
}

inline ObjectEstimator estimatorOf(
    const std::vector<ObjectView>& views, const EstimatorOptions& options)
{
  ObjectEstimator e;
  for (const auto& v : views) e.add(v, options);
  return e;
}

inline void expectNear(const UprightState& x, const Ellipsoid& truth, double meters, double degrees)
{
  const Ellipsoid estimated = ellipsoidOf(x);
  EXPECT_LT((estimated.center() - truth.center()).norm(), meters);
  const auto rotation = symmetricRotationDistance(truth.rotation(), estimated.rotation());
  EXPECT_LT(rotation.angle * 180 / M_PI, degrees);
}

inline double shapeIoU(const UprightState& x, const Ellipsoid& truth)
{
  const Eigen::Vector3d s = x.tail<3>().array().exp();
  return std::max(
      alignedIoU(s, truth.semiAxes()), alignedIoU({s.y(), s.x(), s.z()}, truth.semiAxes()));
}
}  // namespace quadmap::testing
