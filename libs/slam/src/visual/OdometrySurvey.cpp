#include "quadmap/slam/visual/OdometrySurvey.h"

#include <algorithm>
#include <cmath>

#include "RigidMotion.h"
#include "quadmap/perception/FramePerception.h"
#include "quadmap/slam/SingleMoment.h"
#include "quadmap/slam/visual/VisualOdometry.h"

namespace quadmap
{
namespace
{
constexpr std::size_t kFrames = 15;  // a floor shows at once or the camera does not look down

/** Up in the robot's frame, from the plane the image's scene stands on. A wall that fills the image
 * may be taken for one: nobody holds a camera with its up axis that far from up. */
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

/** Images of one camera, followed by visual odometry, and what each takes for up. */
class UpVotes
{
 public:
  explicit UpVotes(const SlamConfiguration& configuration) :
      perception_(configuration.perception, LabelTable()), odometry_(configuration.visual)
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

/** How much a kind of odometry says of a pose; the higher, the more. */
int rankOf(const std::string& kind)
{
  const std::vector<std::string> ascending = {
      "CObservationOdometry", "CActionRobotMovement2D", "CActionRobotMovement3D",
      "CObservationRobotPose"};
  const auto found = std::find(ascending.begin(), ascending.end(), kind.substr(0, kind.find(' ')));
  return static_cast<int>(found - ascending.begin());
}

/** Of the first images, those that have a pose. */
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

/** Of several kinds the best; those that tie: the first. Empty when there are not several, or none
 * that is of use. */
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
  const double agreement = std::cos(5 * M_PI / 180);  // planes of a depth camera are that good
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
    const std::string& rawlog, RawlogSourceOptions options, const SlamConfiguration& configuration)
{
  const PoseSource wanted = configuration.slam.odometry;
  OdometrySurvey survey{wanted, {}, {}};
  const bool usesOdometry = wanted == PoseSource::Auto || wanted == PoseSource::Rawlog;
  if (!usesOdometry && wanted != PoseSource::Visual) return survey;
  options.keepGoing = true;
  UpVotes votes(configuration);
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
      if (hasOdometry) continue;  // the rest only tells of further kinds
      moment.add(*frame);
      if (wanted != PoseSource::Rawlog) votes.add(*frame);
    }
    if (usesOdometry) survey.odometryKind = bestKind(source.odometryKinds(), rawlog, options);
    hasOdometry = hasOdometry || !survey.odometryKind.empty();
    if (wanted == PoseSource::Rawlog || hasOdometry) return survey;
    if (wanted == PoseSource::Auto && moment.isPossible()) return survey;
    survey.source = PoseSource::Visual;
  }
  catch (const std::exception&)
  {
    return survey;  // told by the run itself, which meets it again
  }
  survey.up_robot = votes.result();
  return survey;
}

}  // namespace quadmap
