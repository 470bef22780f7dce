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
};

/** Looks at the first images of a rawlog: whether it has odometry or shows a single moment, which
 * needs none, and, if there is none or visual
 * odometry is wanted, where up is. Broken records are passed over here: who reads the rawlog
 * afterwards reports them. */
OdometrySurvey surveyOdometry(
    const std::string& rawlog, RawlogSourceOptions options, const SlamConfiguration& configuration);

/** The direction most of the others agree with, as their mean; nothing from nothing. */
std::optional<Eigen::Vector3d> agreedDirection(const std::vector<Eigen::Vector3d>& directions);

}  // namespace quadmap
