#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/odometry/PoseSource.h"
#include "quadmap/odometry/UpDirection.h"
#include "quadmap/odometry/VisualOdometryOptions.h"
#include "quadmap/perception/PerceptionOptions.h"
#include "quadmap/sensors/RawlogSource.h"

namespace quadmap
{
/** What the start of a rawlog tells about its poses. */
struct OdometrySurvey
{
  PoseSource source = PoseSource::Auto;  //!< Visual instead of Auto if there is no odometry
  Eigen::Vector3d up_robot = Eigen::Vector3d::UnitZ();  //!< Up at the first image
  UpOrigin upOrigin = UpOrigin::Images;                 //!< What tells up_robot
  /** The best of several kinds of odometry (see RawlogSourceOptions::odometryKind). It is empty
   * when there is at most one kind. */
  std::string odometryKind;
  /** A kind that the rawlog has, but that gave the images no poses, so that visual odometry
   * replaces it. It is empty otherwise. */
  std::string uselessKind;
  /** The first images have no odometry at all, so that visual odometry is used. */
  bool foundNone = false;

  /** The rawlog when it was read to its end and has no image that can be used, so that nobody needs
   * to read it once more to say why; null otherwise. Broken records are among its problems(). */
  std::shared_ptr<RawlogSource> withoutImages;

  /** What to tell the user about `uselessKind`, one line; empty when that is. */
  std::string warning(const std::string& rawlog) const;

  /** What to tell the user at the end of a rawlog that has odometry after all, one line; empty when
   * it has none, or visual odometry does not replace it.
   *  \param kind The odometry that the reader of the whole rawlog met; may be empty. */
  std::string warningOfLateOdometry(const std::string& rawlog, const std::string& kind) const;
};

/** Looks at the first images of a rawlog. It finds out whether the rawlog has odometry, or shows a
 * single moment, which needs none. Of several kinds of odometry it finds the best one. If there is
 * none, or visual odometry is wanted, it finds out where up is. It passes over broken records; the
 * reader of the whole rawlog reports them.
 *
 * The best odometry is chosen among the kinds that have poses for as many images as any other kind
 * has, or for one image less. Of these it is the one that says most about a pose:
 * CObservationRobotPose (six numbers and their covariance) comes before the motions of
 * CActionRobotMovement3D and 2D, and these come before CObservationOdometry (three numbers). Of two
 * that say as much it is the one with more poses, and then the first in the order of the alphabet.
 */
OdometrySurvey surveyOdometry(
    const std::string& rawlog,
    RawlogSourceOptions options,
    PoseSource wanted,
    const PerceptionOptions& perception = {},
    const VisualOdometryOptions& visual = {});

/** The odometry that surveyOdometry() would choose, for programs that need to know nothing else.
 * It is empty when there is at most one kind, or none that gives poses. */
std::string bestOdometryKind(const std::string& rawlog, RawlogSourceOptions options);

/** The same for a camera, whose first images it takes and gives back. A camera has no odometry.
 *  \exception std::runtime_error As FrameSource::next(). */
OdometrySurvey surveyOdometry(
    FrameSource& camera,
    PoseSource wanted,
    const PerceptionOptions& perception,
    const VisualOdometryOptions& visual);

}  // namespace quadmap
