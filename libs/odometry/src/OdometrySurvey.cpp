#include "quadmap/odometry/OdometrySurvey.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "quadmap/odometry/SingleMoment.h"
#include "quadmap/odometry/VisualOdometry.h"
#include "quadmap/perception/FramePerception.h"
#include "visual/RigidMotion.h"

namespace quadmap
{
namespace
{
constexpr std::size_t kFrames = 15;  // images in which the floor is looked for

/** Whether the robot's frame stands on its head when the stored image is upright. An image with
 * negative fy is turned, so what is up in the stored one is -z of its sensor. */
bool isUpsideDown(const RgbdFrame& frame)
{
  return frame.isTurned && isometryOf(frame.scan->sensorPose).linear()(2, 2) > 0;
}

/** The direction that is up in each image of one camera, carried to the first image by visual
 * odometry: doc/mathematics.md, section 15.
 *
 * A wall that fills the image may be mistaken for the floor, so directions far from the robot's z
 * are not believed. A ceiling looks like the floor of a turned image, so directions near z and
 * near -z are kept apart. */
class UpVotes
{
 public:
  UpVotes(const PerceptionOptions& perception, const VisualOdometryOptions& visual) :
      perception_(perception, LabelTable()), odometry_(visual)
  {
  }

  void add(const RgbdFrame& frame)
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
    const auto up_robot = upOfFloor(perception_, *frame.scan);
    if (!up_robot || std::abs(up_robot->z()) < std::cos(kMaxTilt)) return;
    auto& side = up_robot->z() > 0 ? above_ : below_;
    side.push_back(isometryOf(*T_first_robot).linear() * *up_robot);
  }

  /** Sets what the survey says about up. */
  void tell(OdometrySurvey& survey) const
  {
    survey.up_robot.z() = isUpsideDown_ ? -1 : 1;
    auto up_robot = agreedDirection(isUpsideDown_ ? below_ : above_);
    // Only the floor shows that the stored images of a negative fy are upside down.
    if (!up_robot && isTurned_) up_robot = agreedDirection(isUpsideDown_ ? above_ : below_);
    survey.upFromFloor = up_robot.has_value();
    if (up_robot) survey.up_robot = *up_robot;
  }

 private:
  FramePerception perception_;
  VisualOdometry odometry_;
  std::string sensor_;
  bool isTurned_ = false, isUpsideDown_ = false;  // the first image, and what it says
  std::vector<Eigen::Vector3d> above_, below_;    // near the robot's z, and near -z
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

/** A kind of odometry, and the number of the first images that have a pose by it. */
struct KindCoverage
{
  std::string kind;
  std::size_t posed;
};

/** Whether a is better than b. The order of their records says nothing, so names decide at last. */
bool isBetter(const KindCoverage& a, const KindCoverage& b)
{
  const int rankA = rankOf(a.kind), rankB = rankOf(b.kind);
  return std::tie(rankB, b.posed, a.kind) < std::tie(rankA, a.posed, b.kind);
}

/** The best of several kinds. It is empty when there are not several, or when none of them gives
 * poses. */
std::string bestKind(
    const std::vector<std::string>& kinds, const std::string& rawlog, RawlogSourceOptions options)
{
  // An image that comes just before the first pose does not tell which odometry is better.
  constexpr std::size_t kMostBehind = 1;
  if (kinds.size() < 2) return {};
  std::vector<KindCoverage> candidates;
  std::size_t most = 0;
  for (const auto& kind : kinds)
  {
    options.odometryKind = kind;
    candidates.push_back({kind, posedImages(rawlog, options)});
    most = std::max(most, candidates.back().posed);
  }
  const auto coversFewer = [&](const KindCoverage& c)
  { return c.posed == 0 || c.posed + kMostBehind < most; };
  candidates.erase(
      std::remove_if(candidates.begin(), candidates.end(), coversFewer), candidates.end());
  if (candidates.empty()) return {};
  return std::min_element(candidates.begin(), candidates.end(), isBetter)->kind;
}

}  // namespace

std::string OdometrySurvey::warning(const std::string& rawlog) const
{
  if (uselessKind.empty()) return {};
  return rawlog + ": " + uselessKind +
         " has no pose at the times of the first images (is a clock wrong?): visual odometry "
         "replaces it";
}

std::string OdometrySurvey::warningOfLateOdometry(
    const std::string& rawlog, const std::string& kind) const
{
  if (!foundNone || kind.empty()) return {};
  return rawlog + ": " + kind +
         " starts behind the first images, and visual odometry replaced it: records must be in the "
         "order of their times";
}

std::optional<Eigen::Vector3d> upOfFloor(
    const FramePerception& perception, const mrpt::obs::CObservation3DRangeScan& scan)
{
  CObservationObjects noBoxes;
  const auto surfaces = perception.measure(scan, noBoxes, std::nullopt);
  const auto floor = std::find_if(
      surfaces.seen.begin(), surfaces.seen.end(),
      [](const SurfacePatch& patch) { return patch.kind == SurfaceKind::Floor; });
  if (floor == surfaces.seen.end()) return std::nullopt;
  return isometryOf(scan.sensorPose).linear() * floor->plane.n;
}

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

std::string bestOdometryKind(const std::string& rawlog, RawlogSourceOptions options)
{
  options.keepGoing = true;
  options.readBoxes = false;
  try
  {
    RawlogSource source(rawlog, options);
    source.logging_enable_console_output = false;
    for (std::size_t i = 0; i < kFrames && source.next(); ++i) continue;
    return bestKind(source.odometryKinds(), rawlog, options);
  }
  catch (const std::exception&)
  {
    return {};  // whoever reads the rawlog meets the same error and reports it
  }
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
  const bool endsAtProblems = !options.keepGoing;
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
    // The run meets the same error and reports it; what else there is does not matter then.
    if (endsAtProblems && !source.problems().empty()) return survey;
    if (usesOdometry) survey.odometryKind = bestKind(source.odometryKinds(), rawlog, options);
    hasOdometry = hasOdometry || !survey.odometryKind.empty();
    if (wanted == PoseSource::Rawlog || hasOdometry) return survey;
    if (wanted == PoseSource::Auto && moment.isPossible()) return survey;
    survey.source = PoseSource::Visual;
    survey.foundNone = usesOdometry && source.odometryKinds().empty();
    if (usesOdometry && !survey.foundNone) survey.uselessKind = source.odometryKinds().front();
  }
  catch (const std::exception&)
  {
    return survey;  // the run meets the same error and reports it
  }
  votes.tell(survey);
  return survey;
}

OdometrySurvey surveyOdometry(
    FrameSource& camera,
    PoseSource wanted,
    const PerceptionOptions& perception,
    const VisualOdometryOptions& visual)
{
  OdometrySurvey survey;
  survey.source = wanted;
  if (wanted != PoseSource::Auto && wanted != PoseSource::Visual) return survey;
  UpVotes votes(perception, visual);
  SingleMoment moment;
  std::vector<RgbdFrame> frames;
  while (frames.size() < kFrames)
  {
    auto frame = camera.next();
    if (!frame) break;
    moment.add(*frame);
    frames.push_back(std::move(*frame));
    try
    {
      votes.add(frames.back());
    }
    catch (const std::exception&)
    {
      break;  // the run meets the same error and reports it
    }
  }
  camera.giveBack(frames);
  if (wanted == PoseSource::Auto && moment.isPossible()) return survey;
  survey.source = PoseSource::Visual;
  votes.tell(survey);
  return survey;
}

}  // namespace quadmap
