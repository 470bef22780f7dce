#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "quadmap/odometry/OdometrySurvey.h"
#include "quadmap/odometry/UpDirection.h"
#include "quadmap/odometry/VisualOdometry.h"

namespace quadmap
{
/** The directions that are up in the images of one camera, carried to the first image by visual
 * odometry: doc/mathematics.md, section 15. Floors near the robot's z and near -z are kept apart,
 * as only floors tell that the stored images are upside down. */
class UpVotes
{
 public:
  UpVotes(const PerceptionOptions& perception, const VisualOdometryOptions& visual);

  /** Images of other cameras than the first one's are passed over. */
  void add(const RgbdFrame& frame);

  /** Sets what the survey says about up. */
  void tell(OdometrySurvey& survey) const;

 private:
  /** Of images that are held upright, in the robot's frame. */
  Eigen::Vector3d assumedUp() const { return {0, 0, isUpsideDown_ ? -1.0 : 1.0}; }

  UpFinder finder_;
  VisualOdometry odometry_;
  std::string sensor_;
  bool isTurned_ = false, isUpsideDown_ = false;  // the first image, and what it says
  std::vector<Eigen::Vector3d> above_, below_;    // by the floor, near the robot's z, and near -z
  std::vector<Eigen::Vector3d> surfaces_;         // by other surfaces
};

}  // namespace quadmap
