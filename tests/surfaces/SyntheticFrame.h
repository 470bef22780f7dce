#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <Eigen/Dense>
#include <string>
#include <utility>
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
  std::pair<int, double> look(unsigned u, unsigned v) const;

  mrpt::obs::CObservation3DRangeScan scan() const;

  /** A perfect detector's box: around the visible pixels of one box. */
  DetectedObject detect(std::size_t index, const std::string& label) const;

  CObservationObjects observation(const std::vector<DetectedObject>& objects) const
  {
    CObservationObjects out;
    out.cameraParams = camera;
    out.objects = objects;
    return out;
  }
};

}  // namespace quadmap
