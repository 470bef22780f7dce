#include "UpVotes.h"

#include <cmath>

#include "visual/RigidMotion.h"

namespace quadmap
{
namespace
{
/** Whether the robot's frame stands on its head when the stored image is upright. An image with
 * negative fy is turned, so what is up in the stored one is -z of its sensor. */
bool isUpsideDown(const RgbdFrame& frame)
{
  return frame.isTurned && isometryOf(frame.scan->sensorPose).linear()(2, 2) > 0;
}
}  // namespace

UpVotes::UpVotes(const PerceptionOptions& perception, const VisualOdometryOptions& visual) :
    options_(perception), perception_(perception, LabelTable()), odometry_(visual)
{
}

void UpVotes::add(const RgbdFrame& frame)
{
  if (odometry_.counts().frames == 0)
  {
    sensor_ = frame.scan->sensorLabel;
    isTurned_ = frame.isTurned;
    isUpsideDown_ = isUpsideDown(frame);
  }
  if (frame.scan->sensorLabel != sensor_) return;
  const auto T_first_robot = odometry_.add(*frame.scan);
  if (!T_first_robot || odometry_.counts().gaps > 0) return;
  constexpr double kMaxTilt = M_PI / 3;
  const Eigen::Matrix3d R_first_robot = isometryOf(*T_first_robot).linear();
  const auto up_robot = upOfFloor(perception_, *frame.scan);
  if (up_robot && std::abs(up_robot->z()) > std::cos(kMaxTilt))
    (up_robot->z() > 0 ? above_ : below_)
        .push_back(R_first_robot * levelled(options_, *frame.scan, *up_robot));
  else if (const auto up = upOfSurfaces(options_, *frame.scan, assumedUp()))
    surfaces_.push_back(R_first_robot * *up);
}

void UpVotes::tell(OdometrySurvey& survey) const
{
  survey.up_robot = assumedUp();
  auto up_robot = agreedDirection(isUpsideDown_ ? below_ : above_);
  // Only the floor shows that the stored images of a negative fy are upside down.
  if (!up_robot && isTurned_) up_robot = agreedDirection(isUpsideDown_ ? above_ : below_);
  survey.upOrigin = up_robot ? UpOrigin::Floor : UpOrigin::Images;
  if (!up_robot)
  {
    up_robot = agreedDirection(surfaces_);
    if (up_robot) survey.upOrigin = UpOrigin::Surfaces;
  }
  if (up_robot) survey.up_robot = *up_robot;
}

}  // namespace quadmap
