#include "UpVotes.h"

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
    finder_(perception), odometry_(visual)
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
  const auto floors = isTurned_ ? BelievedFloors::BelowOrAbove : BelievedFloors::Below;
  const auto seen = finder_.find(*frame.scan, assumedUp(), floors);
  if (!seen) return;
  auto& votes = seen->origin == UpOrigin::Surfaces ? surfaces_
                : seen->up_robot.z() > 0           ? above_
                                                   : below_;
  votes.push_back(isometryOf(*T_first_robot).linear() * seen->up_robot);
}

void UpVotes::tell(OdometrySurvey& survey) const
{
  auto floor = agreedDirection(isUpsideDown_ ? below_ : above_);
  // Only the floor shows that the stored images of a negative fy are upside down.
  if (!floor && isTurned_) floor = agreedDirection(isUpsideDown_ ? above_ : below_);
  const auto surfaces = agreedDirection(surfaces_);
  const bool surfacesTell = surfaces && surfaces->isMajorityOf(surfaces_.size());
  const bool floorTells =
      floor && (!surfacesTell || floor->isMajorityOf(above_.size() + below_.size()));
  survey.upOrigin = floorTells     ? UpOrigin::Floor
                    : surfacesTell ? UpOrigin::Surfaces
                                   : UpOrigin::Images;
  survey.up_robot = floorTells     ? floor->direction
                    : surfacesTell ? surfaces->direction
                                   : assumedUp();
}

}  // namespace quadmap
