#include "quadmap/navigation/LocalizationRun.h"

#include <chrono>
#include <limits>
#include <set>
#include <stdexcept>

#include "FloorLevel.h"
#include "quadmap/base/ErrorText.h"
#include "quadmap/base/ModuleTimes.h"
#include "quadmap/odometry/OdometryInput.h"
#include "quadmap/odometry/OdometrySurvey.h"
#include "quadmap/perception/RoomPerception.h"
#include "quadmap/sensors/KeyframeSelector.h"
#include "quadmap/sensors/RawlogSource.h"
#include "quadmap/sensors/RememberedStop.h"

namespace quadmap
{
using mrpt::poses::CPose3D;

namespace
{
RawlogSourceOptions sourceOptions(const LocalizationRequest& request)
{
  RawlogSourceOptions options;
  options.objectsFile = request.objectsFile;
  options.sensorLabel = request.sensorLabel;
  options.keepGoing = request.keepGoing;
  options.pixelLabelClasses = request.map->labels();
  options.minLabelPixels = request.configuration.perception.minLabelPixels;
  options.shouldStop = request.shouldStop;
  return options;
}

RawlogSourceOptions withOdometry(RawlogSourceOptions options, const OdometrySurvey& survey)
{
  options.odometryKind = survey.odometryKind;
  return options;
}

StartRegion startRegionOf(const LocalizationRequest& request)
try
{
  return regionOf(*request.map, request.configuration.localization.startMargin);
}
catch (const std::invalid_argument& e)
{
  throw std::invalid_argument(request.mapFile + ": " + e.what());
}

/** A camera that stands still repeats its mistakes, however long it does. */
KeyframeOptions byMotion(const LocalizationOptions& options)
{
  KeyframeOptions chosen;
  chosen.minTranslation = options.updateDistance;
  chosen.minRotation = options.updateAngle;
  chosen.maxInterval = std::numeric_limits<double>::infinity();
  return chosen;
}

/** How many boxes may show something of the map. */
std::size_t comparedBoxes(const FrameLikelihood& seen)
{
  std::set<std::size_t> boxes;
  for (const auto& pairing : seen.pairings()) boxes.insert(pairing.box);
  return boxes.size();
}

class LocalizationRun
{
 public:
  explicit LocalizationRun(const LocalizationRequest& request) :
      request_(request),
      options_(request.configuration.localization),
      region_(startRegionOf(request)),
      survey_(surveyOdometry(
          request.rawlog,
          sourceOptions(request),
          request.odometry,
          request.configuration.perception,
          request.configuration.visual)),
      source_(request.rawlog, withOdometry(sourceOptions(request), survey_)),
      odometry_(
          survey_.source,
          request.configuration.poses,
          request.configuration.visual,
          survey_.up_robot),
      perception_(request.configuration.perception, request.map->labels()),
      selector_(byMotion(options_)),
      level_(options_.floorShare)
  {
    source_.sendWarningsTo(request.onWarning);
    const std::string warning = survey_.warning(request.rawlog);
    if (!warning.empty()) request_.onWarning(warning);
  }

  LocalizationResult run()
  {
    while (!(result_.interrupted = request_.shouldStop()))
    {
      const auto frame = source_.next();
      request_.onProgress(
          source_.progress(), filter_ ? filter_->estimate() : LocalizationEstimate());
      if (!frame)
      {
        result_.interrupted = source_.wasStopped();
        break;
      }
      add(*frame);
    }
    for (const auto& problem : source_.problems()) result_.dropped.push_back(problem.text());
    const std::string late = survey_.warningOfLateOdometry(request_.rawlog, source_.odometryKind());
    if (!late.empty()) request_.onWarning(late);
    const std::string jumps = odometry_.warningOfJumps();
    if (!jumps.empty()) request_.onWarning(request_.rawlog + ": " + jumps);
    result_.odometry = odometryText();
    const std::string lack = odometry_.missingPoses();
    if (!lack.empty()) request_.onWarning(request_.rawlog + ": " + lack + " and were left out");
    if (!result_.interrupted) requireContent();
    return std::move(result_);
  }

 private:
  void add(const RgbdFrame& frame)
  try
  {
    ++result_.frames;
    const auto T_odom_robot = odometry_.poseOf(frame);
    for (const auto& text : odometry_.takeWarnings())
      request_.onWarning(request_.rawlog + ": " + text);
    if (!T_odom_robot)
    {
      ++result_.framesWithoutPose;
      return;
    }
    // An image without boxes takes the place of none that has some; the next step holds its motion.
    if (!frame.objects || frame.objects->objects.empty()) return;
    const CPose3D T_odom_sensor = *T_odom_robot + frame.scan->sensorPose;
    if (!selector_.isKeyframe(frame.scan->sensorLabel, frame.time(), T_odom_sensor)) return;
    CObservationObjects boxes = *frame.objects;
    measure(*frame.scan, boxes, *T_odom_robot);
    const CPose3D T_level_robot = level_.levelled(*T_odom_robot);
    moveTo(T_level_robot);
    weigh(boxes, T_level_robot, frame.time());
  }
  catch (const std::exception& e)
  {
    const InputProblem problem{
        request_.rawlog, frame.record, frame.scan->sensorLabel, rootMessage(e)};
    if (!request_.keepGoing) throw std::runtime_error(problem.text());
    result_.dropped.push_back(problem.text());
  }

  void moveTo(const CPose3D& T_level_robot)
  {
    const auto step = odometry_.keyframeStep();
    if (!filter_)
      filter_.emplace(options_, region_, T_level_robot, request_.threads);
    else if (step)
      timed([&] { filter_->predict(*step, T_level_robot); });
  }

  /** Measures the boxes, and finds how the odometry is tilted. */
  void measure(
      const mrpt::obs::CObservation3DRangeScan& scan,
      CObservationObjects& boxes,
      const CPose3D& T_odom_robot)
  {
    const double start = processCpuTime();
    const CPose3D T_level_sensor = level_.levelled(T_odom_robot) + scan.sensorPose;
    level_.look(perception_.measure(scan, boxes, T_level_sensor), T_level_sensor);
    result_.measureSeconds += processCpuTime() - start;
  }

  void weigh(const CObservationObjects& boxes, const CPose3D& T_level_robot, double time)
  {
    timed(
        [&]
        {
          const auto seen = request_.map->likelihoodOf(boxes, T_level_robot);
          if (seen.pairings().empty()) return;
          filter_->update(seen);
          result_.updates.push_back({time, comparedBoxes(seen), filter_->estimate()});
        });
  }

  template <typename F>
  void timed(const F& work)
  {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    result_.filterSeconds += passed.count();
  }

  std::string odometryText() const
  {
    if (odometry_.source() == PoseSource::Visual)
      return "visual odometry " + odometry_.visualSensor();
    return odometry_.source() == PoseSource::GroundTruth ? "ground truth" : source_.odometryKind();
  }

  /** Why there is no result; empty when there is one. */
  std::string failure() const
  {
    if (result_.frames == 0) return source_.whyNoFrames();
    if (result_.framesWithoutPose == result_.frames) return odometry_.whyNoPoses();
    if (!request_.keepGoing && odometry_.lacksMostPoses())
      return odometry_.missingPoses() + "; --keep-going leaves them out";
    if (result_.updates.empty())
      return source_.hasBoxes()
                 ? "none of its boxes can show an object of " + request_.mapFile
                 : "no object boxes, neither in it nor " +
                       (request_.objectsFile.empty() ? "beside it" : "in " + request_.objectsFile);
    if (result_.trajectory().empty())
      return "the robot was not found in " + request_.mapFile + " (" +
             std::to_string(result_.updates.size()) + " images were compared with it)";
    return {};
  }

  void requireContent() const
  {
    std::string text = failure();
    if (text.empty()) return;
    if (result_.frames > 0 && !result_.dropped.empty())
      text += "; left out: " + std::to_string(result_.dropped.size()) + ", the first being " +
              result_.dropped.front();
    throw std::runtime_error(request_.rawlog + ": " + text);
  }

  const LocalizationRequest& request_;
  const LocalizationOptions& options_;
  StartRegion region_;
  OdometrySurvey survey_;
  RawlogSource source_;
  OdometryInput odometry_;
  RoomPerception perception_;  // its map is the frame of the odometry
  KeyframeSelector selector_;
  FloorLevel level_;
  std::optional<ParticleLocalization> filter_;
  LocalizationResult result_;
};

}  // namespace

Trajectory LocalizationResult::trajectory() const
{
  Trajectory poses;
  for (const auto& update : updates)
    if (update.estimate.isLocalised) poses.push_back({update.time, update.estimate.T_map_robot});
  return poses;
}

std::optional<std::size_t> LocalizationResult::localisedFrom() const
{
  std::size_t first = updates.size();
  while (first > 0 && updates[first - 1].estimate.isLocalised) --first;
  if (first == updates.size()) return std::nullopt;
  return first;
}

LocalizationResult localiseInMap(const LocalizationRequest& request)
{
  LocalizationRequest remembering = request;
  remembering.shouldStop = rememberedStop(request.shouldStop);
  return LocalizationRun(remembering).run();
}

}  // namespace quadmap
