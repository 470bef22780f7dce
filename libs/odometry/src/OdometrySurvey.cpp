#include "quadmap/odometry/OdometrySurvey.h"

#include <algorithm>
#include <cmath>

#include "quadmap/odometry/SingleMoment.h"
#include "quadmap/odometry/VisualOdometry.h"
#include "quadmap/perception/FramePerception.h"
#include "visual/RigidMotion.h"

namespace quadmap
{
namespace
{
constexpr std::size_t kFrames = 15;  // images in which the floor is looked for

/** Up in the robot's frame: the normal of the plane on which everything in the image stands. A wall
 * that fills the image may be mistaken for this plane. A direction that is far from the camera's
 * own up axis is therefore not believed. */
std::optional<Eigen::Vector3d> upIn(
    const FramePerception& perception, const mrpt::obs::CObservation3DRangeScan& scan)
{
  constexpr double kMaxTilt = M_PI / 3;
  CObservationObjects noBoxes;
  const auto surfaces = perception.measure(scan, noBoxes, std::nullopt);
  const auto floor = std::find_if(
      surfaces.seen.begin(), surfaces.seen.end(),
      [](const SurfacePatch& patch) { return patch.kind == SurfaceKind::Floor; });
  if (floor == surfaces.seen.end()) return std::nullopt;
  const Eigen::Vector3d up_robot = isometryOf(scan.sensorPose).linear() * floor->plane.n;
  if (up_robot.z() < std::cos(kMaxTilt)) return std::nullopt;
  return up_robot;
}

/** The direction that is up in each image of one camera, carried to the first image by visual
 * odometry: doc/mathematics.md, section 15. */
class UpVotes
{
 public:
  UpVotes(const PerceptionOptions& perception, const VisualOdometryOptions& visual) :
      perception_(perception, LabelTable()), odometry_(visual)
  {
  }

  void add(const RgbdFrame& frame)
  {
    if (odometry_.counts().frames == 0) sensor_ = frame.scan->sensorLabel;
    if (frame.scan->sensorLabel != sensor_) return;
    const auto T_first_robot = odometry_.add(*frame.scan);
    if (!T_first_robot || odometry_.counts().gaps > 0) return;
    if (const auto up_robot = upIn(perception_, *frame.scan))
      ups_.push_back(isometryOf(*T_first_robot).linear() * *up_robot);
  }

  std::optional<Eigen::Vector3d> result() const { return agreedDirection(ups_); }

 private:
  FramePerception perception_;
  VisualOdometry odometry_;
  std::string sensor_;
  std::vector<Eigen::Vector3d> ups_;
};

/** How much a kind of odometry says about a pose: the higher, the more. */
int rankOf(const std::string& kind)
{
  const std::vector<std::string> ascending = {
      "CObservationOdometry", "CActionRobotMovement2D", "CActionRobotMovement3D",
      "CObservationRobotPose"};
  const auto found = std::find(ascending.begin(), ascending.end(), kind.substr(0, kind.find(' ')));
  return static_cast<int>(found - ascending.begin());
}

/** Number of the first images that have a pose by this odometry. */
std::size_t posedImages(const std::string& rawlog, const RawlogSourceOptions& options)
{
  RawlogSource source(rawlog, options);
  source.logging_enable_console_output = false;
  std::size_t posed = 0;
  for (std::size_t i = 0; i < kFrames; ++i)
  {
    const auto frame = source.next();
    if (!frame) break;
    posed += frame->T_odom_robot ? 1 : 0;
  }
  return posed;
}

/** The best of several kinds, and of equal ones the first. It is empty when there are not several,
 * or when none of them gives poses. */
std::string bestKind(
    const std::vector<std::string>& kinds, const std::string& rawlog, RawlogSourceOptions options)
{
  if (kinds.size() < 2) return {};
  std::vector<std::size_t> posed;
  for (const auto& kind : kinds)
  {
    options.odometryKind = kind;
    posed.push_back(posedImages(rawlog, options));
  }
  const std::size_t most = *std::max_element(posed.begin(), posed.end());
  std::string best;
  if (most == 0) return best;
  for (std::size_t i = 0; i < kinds.size(); ++i)
    if (2 * posed[i] >= most && (best.empty() || rankOf(kinds[i]) > rankOf(best))) best = kinds[i];
  return best;
}

}  // namespace

std::optional<Eigen::Vector3d> agreedDirection(const std::vector<Eigen::Vector3d>& directions)
{
  const double agreement = std::cos(5 * M_PI / 180);  // accuracy of the planes of a depth camera
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  int mostVotes = 0;
  for (const auto& candidate : directions)
  {
    int votes = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& other : directions)
      if (candidate.dot(other) > agreement)
      {
        sum += other;
        ++votes;
      }
    if (votes <= mostVotes) continue;
    mostVotes = votes;
    best = sum.normalized();
  }
  if (mostVotes == 0) return std::nullopt;
  return best;
}

OdometrySurvey surveyOdometry(
    const std::string& rawlog,
    RawlogSourceOptions options,
    PoseSource wanted,
    const PerceptionOptions& perception,
    const VisualOdometryOptions& visual)
{
  OdometrySurvey survey;
  survey.source = wanted;
  const bool usesOdometry = wanted == PoseSource::Auto || wanted == PoseSource::Rawlog;
  if (!usesOdometry && wanted != PoseSource::Visual) return survey;
  options.keepGoing = true;
  UpVotes votes(perception, visual);
  try
  {
    RawlogSource source(rawlog, options);
    source.logging_enable_console_output = false;
    bool hasOdometry = false;
    SingleMoment moment;
    for (std::size_t i = 0; i < kFrames; ++i)
    {
      const auto frame = source.next();
      if (!frame) break;
      hasOdometry = hasOdometry || (usesOdometry && frame->T_odom_robot);
      if (hasOdometry) continue;  // all later records can only show further kinds
      moment.add(*frame);
      if (wanted != PoseSource::Rawlog) votes.add(*frame);
    }
    if (usesOdometry) survey.odometryKind = bestKind(source.odometryKinds(), rawlog, options);
    hasOdometry = hasOdometry || !survey.odometryKind.empty();
    if (wanted == PoseSource::Rawlog || hasOdometry) return survey;
    if (wanted == PoseSource::Auto && moment.isPossible()) return survey;
    survey.source = PoseSource::Visual;
    if (usesOdometry && !source.odometryKinds().empty())
      survey.uselessKind = source.odometryKinds().front();
  }
  catch (const std::exception&)
  {
    return survey;  // the run meets the same error and reports it
  }
  survey.up_robot = votes.result();
  return survey;
}

}  // namespace quadmap
