#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "quadmap/obs/LabelTable.h"
#include "quadmap/odometry/OdometrySurvey.h"
#include "quadmap/odometry/VisualOdometry.h"
#include "quadmap/perception/FramePerception.h"

namespace quadmap
{
/** The direction that is up in each image of one camera, carried to the first image by visual
 * odometry: doc/mathematics.md, section 15.
 *
 * A wall that fills the image may be mistaken for the floor, so directions far from the robot's z
 * are not believed. A ceiling looks like the floor of a turned image, so directions near z and
 * near -z are kept apart. */
class UpVotes
{
 public:
  UpVotes(const PerceptionOptions& perception, const VisualOdometryOptions& visual);

  /** Those of other cameras than the first one's are passed over. */
  void add(const RgbdFrame& frame);

  /** Sets what the survey says about up. */
  void tell(OdometrySurvey& survey) const;

 private:
  /** Of images that are held upright, in the robot's frame. */
  Eigen::Vector3d assumedUp() const { return {0, 0, isUpsideDown_ ? -1.0 : 1.0}; }

  PerceptionOptions options_;
  FramePerception perception_;
  VisualOdometry odometry_;
  std::string sensor_;
  bool isTurned_ = false, isUpsideDown_ = false;  // the first image, and what it says
  std::vector<Eigen::Vector3d> above_, below_;    // by the floor, near the robot's z, and near -z
  std::vector<Eigen::Vector3d> surfaces_;         // by other surfaces
};

}  // namespace quadmap
