#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <Eigen/Dense>
#include <limits>
#include <random>
#include <vector>

#include "quadmap/geometry/Ellipsoid.h"
#include "quadmap/geometry/Projection.h"
#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** A world of boxes on a floor (z = 0), looked at by one camera: exact depth by intersecting each
 * pixel's ray with every box, independent of the code under test. */
class SyntheticFrame
{
 public:
  struct Box
  {
    Ellipsoid cuboid;
    bool hasDepth = true;  //!< False: a screen; it hides what is behind and returns nothing
  };

  /** \param pitchDown Of the camera [rad]. */
  explicit SyntheticFrame(double cameraHeight = 1.3, double pitchDown = 0.45) :
      T_world_sensor(0, 0, cameraHeight, 0, pitchDown, 0)
  {
    camera.setIntrinsicParamsFromValues(525, 525, 319.5, 239.5);
    camera.ncols = 640;
    camera.nrows = 480;
  }

  mrpt::img::TCamera camera;
  mrpt::poses::CPose3D T_world_sensor;
  std::vector<Box> boxes;
  bool hasFloor = true;
  double noise = 0;  //!< Standard deviation of depth at 1 m, growing with z^2 [m]

  void add(double x, double y, double bottom, double yaw, const Eigen::Vector3d& size)
  {
    boxes.push_back({Ellipsoid({x, y, bottom + size.z() / 2, yaw, 0, 0}, size / 2), true});
  }

  Eigen::Vector3d up_sensor() const { return T_world_sensor.getRotationMatrix().asEigen().row(2); }

  /** Index of the box a pixel shows: -1 floor, -2 nothing; its depth along the optical axis [m]. */
  std::pair<int, double> look(unsigned u, unsigned v) const
  {
    const mrpt::poses::CPose3D T_world_optical = T_world_sensor + T_sensor_optical();
    const Eigen::Matrix3d R = T_world_optical.getRotationMatrix().asEigen();
    const Eigen::Vector3d o(T_world_sensor.x(), T_world_sensor.y(), T_world_sensor.z());
    const Eigen::Vector3d d = R * pinholeFrom(camera).ray(u, v);
    std::pair<int, double> hit = {-2, std::numeric_limits<double>::infinity()};
    if (hasFloor && d.z() < 0) hit = {-1, -o.z() / d.z()};
    for (std::size_t i = 0; i < boxes.size(); ++i)
    {
      const Ellipsoid& box = boxes[i].cuboid;
      const Eigen::Vector3d ob = box.rotation().transpose() * (o - box.center());
      const Eigen::Vector3d db = box.rotation().transpose() * d;
      double enter = 0, leave = hit.second;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double a = (-box.semiAxes()[axis] - ob[axis]) / db[axis];
        const double b = (box.semiAxes()[axis] - ob[axis]) / db[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      }
      if (enter < leave && enter > 0 && enter < hit.second) hit = {static_cast<int>(i), enter};
    }
    return hit;
  }

  mrpt::obs::CObservation3DRangeScan scan() const
  {
    mrpt::obs::CObservation3DRangeScan out;
    out.hasRangeImage = true;
    out.range_is_depth = true;
    out.rangeUnits = 1e-4f;
    out.rangeImage_setSize(static_cast<int>(camera.nrows), static_cast<int>(camera.ncols));
    out.cameraParams = camera;
    std::mt19937 generator(7);
    std::normal_distribution<double> normal;
    for (unsigned v = 0; v < camera.nrows; ++v)
      for (unsigned u = 0; u < camera.ncols; ++u)
      {
        const auto [box, z] = look(u, v);
        const double measured = z + noise * z * z * normal(generator);
        const bool returns = box < 0 || boxes[static_cast<std::size_t>(box)].hasDepth;
        const bool seen = returns && measured > 0 && measured < 6.5;
        out.rangeImage(static_cast<int>(v), static_cast<int>(u)) =
            seen ? static_cast<std::uint16_t>(measured / 1e-4) : std::uint16_t(0);
      }
    return out;
  }

  /** A perfect detector's box: around the visible pixels of one box. */
  DetectedObject detect(std::size_t index, const std::string& label) const
  {
    DetectedObject out;
    out.label = label;
    out.box = {1e9, 1e9, -1e9, -1e9};
    for (unsigned v = 0; v < camera.nrows; ++v)
      for (unsigned u = 0; u < camera.ncols; ++u)
        if (look(u, v).first == static_cast<int>(index))
          out.box = {
              std::min(out.box.x1, double(u)), std::min(out.box.y1, double(v)),
              std::max(out.box.x2, double(u)), std::max(out.box.y2, double(v))};
    return out;
  }

  CObservationObjects observation(const std::vector<DetectedObject>& objects) const
  {
    CObservationObjects out;
    out.cameraParams = camera;
    out.objects = objects;
    return out;
  }
};

}  // namespace quadmap
