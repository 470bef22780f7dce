#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/estimation/BoxMeasurement.h"
#include "quadmap/maps/MapOptions.h"
#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/quadric/QuadricInitialisation.h"

namespace quadmap
{
/** The outline of a thing is not that of an ellipsoid: standard deviation of an edge, as a share of
 * the mean semi-axis. That of |n_x| + |n_y| + |n_z|, the half width of a cube, over all directions.
 */
constexpr double kOutlineSpread = 0.15;

/** One detector box of one keyframe as planes through the camera, in the robot's frame: all that a
 * method without depth has of an object. */
struct BoxView
{
  struct Edge
  {
    Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  //!< Towards the object
    double angleSigma = 0;                              //!< At the camera [rad]
    bool usable = false;                                //!< Not cut by the image's border
  };

  std::size_t keyframe = 0, box = 0;  //!< Indices of the keyframe and of the box in its image
  std::string label;                  //!< Canonical
  std::optional<std::uint32_t> instance;
  Eigen::Vector3d camera = Eigen::Vector3d::Zero();  //!< Its centre [m]
  std::array<Edge, 4> edges;                         //!< Left, top, right, bottom
  double fieldOfView = 1;  //!< Width and height of the image as angles, their geometric mean [rad]

  std::size_t usableEdges() const;
  PlacedBox placedAt(const mrpt::poses::CPose3D& T_map_robot) const;

  /** As the factor graph has it. \param object As it is known: sigmas grow with its distance and
   * its size. */
  BoxMeasurement measurementFor(
      const mrpt::poses::CPose3D& T_map_robot,
      const Ellipsoid& object,
      const PoseNoise& noise,
      const EstimatorOptions& options) const;
};

/** The boxes of an image that are worth something: sure enough, no twins of a better one, with an
 * edge that is not cut. */
std::vector<BoxView> boxViewsOf(
    const CObservationObjects& boxes,
    std::size_t keyframe,
    const LabelTable& labels,
    const InsertionOptions& options);

}  // namespace quadmap
