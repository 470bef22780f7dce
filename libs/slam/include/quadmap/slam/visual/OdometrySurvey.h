#pragma once

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/sensors/RawlogSource.h"
#include "quadmap/slam/SlamConfiguration.h"

namespace quadmap
{
/** What the start of a rawlog tells about poses. */
struct OdometrySurvey
{
  PoseSource source = PoseSource::Auto;     //!< Visual instead of Auto when there is no odometry
  std::optional<Eigen::Vector3d> up_robot;  //!< At the first image, from the floor; needs no poses
  /** The best of several kinds of odometry (RawlogSourceOptions::odometryKind); empty: there are
   * not several. */
  std::string odometryKind;
};

/** Looks at the first images of a rawlog: whether it has odometry or shows a single moment, which
 * needs none; which odometry is best when there are several; and, if there is none or visual
 * odometry is wanted, where up is. Broken records are passed over here: who reads the rawlog
 * afterwards reports them.
 *
 * Best is what has poses for the images: of the kinds that know at least half as many as any other
 * does, the one that says most of a pose. CObservationRobotPose (six numbers and their covariance)
 * comes before the increments of CActionRobotMovement3D and 2D, and these before
 * CObservationOdometry (three numbers). */
OdometrySurvey surveyOdometry(
    const std::string& rawlog, RawlogSourceOptions options, const SlamConfiguration& configuration);

/** The direction most of the others agree with, as their mean; nothing from nothing. */
std::optional<Eigen::Vector3d> agreedDirection(const std::vector<Eigen::Vector3d>& directions);

}  // namespace quadmap
