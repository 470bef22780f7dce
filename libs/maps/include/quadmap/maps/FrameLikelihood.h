#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "quadmap/estimation/MapObject.h"
#include "quadmap/estimation/ObjectView.h"
#include "quadmap/maps/MapOptions.h"

namespace quadmap
{
/** A pose of the robot in the map, whose pitch and roll are known otherwise. */
struct LevelPose
{
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  //!< [m]
  double yaw = 0;                                      //!< [rad]
};

/** The log-likelihood of one frame from any pose: doc/mathematics.md, section 14. It is prepared
 * once (CQuadricObjectMap::likelihoodOf), then cheap for thousands of poses, as those of a particle
 * filter. A value of its own, which does not follow the map it was made of. May be used by several
 * threads at once. */
class FrameLikelihood
{
 public:
  /** A box of the frame in the level frame: z up, its origin at the robot, the robot's yaw 0. */
  struct Box
  {
    ObjectView view;
    bool hasSeed = false;   //!< Depth says where it is; always so when the view is complete
    bool hasPlace = false;  //!< `view.center` means something
    Eigen::Vector3d forward = Eigen::Vector3d::UnitX();  //!< Where the camera looks
  };

  /** What is compared with the boxes of an object of the map. */
  struct Target
  {
    Ellipsoid object;                 //!< In the map
    Eigen::Matrix3d covariance;       //!< Of its centre [m^2]
    double yaw = 0, yawVariance = 0;  //!< [rad], [rad^2]
    bool orientationDefined = true;
    double shapeExponent = 2;
  };

  /** That a box may show an object, by its label. */
  struct Pairing
  {
    std::size_t box = 0, target = 0;
    double agreement = 0;  //!< Of the labels, in (0, 1]
  };

  /** \param pairings Sorted by box. */
  FrameLikelihood(
      std::vector<Box> boxes,
      std::vector<Target> targets,
      std::vector<Pairing> pairings,
      const LikelihoodOptions& options);

  /** The sum (14.1) over the boxes, at most 0; 0 when no box says anything. */
  double at(const LevelPose& pose) const;

  const std::vector<Box>& boxes() const { return boxes_; }
  const std::vector<Target>& targets() const { return targets_; }
  const std::vector<Pairing>& pairings() const { return pairings_; }

 private:
  struct Placed;  // a box at a pose

  double completeTerm(const Placed& box, const Target& target) const;
  double edgesTerm(const Placed& box, const Target& target) const;

  std::vector<Box> boxes_;
  std::vector<Target> targets_;
  std::vector<Pairing> pairings_;
  LikelihoodOptions options_;
};

}  // namespace quadmap
