#include "quadmap/odometry/OdometrySurvey.h"

#include <algorithm>
#include <tuple>

#include "UpVotes.h"
#include "quadmap/odometry/SingleMoment.h"
#include "quadmap/sensors/RememberedStop.h"

namespace quadmap
{
namespace
{
constexpr std::size_t kFrames = 15;  // images that are looked at

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
    std::vector<std::string> kinds, const std::string& rawlog, RawlogSourceOptions options)
{
  // Each kind takes another look at the rawlog, and a damaged one may have any number of them.
  constexpr std::size_t kMostKinds = 8;
  // An image that comes just before the first pose does not tell which odometry is better.
  constexpr std::size_t kMostBehind = 1;
  if (kinds.size() < 2) return {};
  std::stable_sort(
      kinds.begin(), kinds.end(),
      [](const auto& a, const auto& b) { return rankOf(a) > rankOf(b); });
  std::vector<KindCoverage> candidates;
  std::size_t most = 0;
  for (const auto& kind : kinds)
  {
    if (candidates.size() == kMostKinds) break;
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

std::string bestOdometryKind(const std::string& rawlog, RawlogSourceOptions options)
{
  options.keepGoing = true;
  options.readBoxes = false;
  try
  {
    RawlogSource source(rawlog, options);
    source.logging_enable_console_output = false;
    for (std::size_t i = 0; i < kFrames && source.next(); ++i) continue;
    if (source.framesRead() == 0) return {};
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
  options.shouldStop = rememberedStop(options.shouldStop);
  options.keepGoing = true;
  UpVotes votes(perception, visual);
  try
  {
    const auto rawlogSource = std::make_shared<RawlogSource>(rawlog, options);
    RawlogSource& source = *rawlogSource;
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
    if (source.wasStopped()) return survey;  // it may know a part only; the run ends at once
    if (source.framesRead() == 0) survey.withoutImages = rawlogSource;
    // The run meets the same error and reports it; what else there is does not matter then.
    if (source.framesRead() == 0 || (endsAtProblems && !source.problems().empty())) return survey;
    if (usesOdometry) survey.odometryKind = bestKind(source.odometryKinds(), rawlog, options);
    if (options.shouldStop()) return survey;  // it may know a part only; the run ends at once
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
