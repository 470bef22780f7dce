// This file chooses the keyframes. ObjectSlam_stages.cpp takes them through the stages,
// and ObjectSlam_warnings.cpp says what is wrong with the result.
#include "run/ObjectSlam.h"

#include "keyframes/BoxCounts.h"
#include "quadmap/base/ErrorText.h"
#include "quadmap/base/Words.h"
#include "quadmap/sensors/RgbdScan.h"

namespace quadmap
{
using mrpt::poses::CPose3D;

namespace
{
/** The keyframes under way: one in each stage, and some more so that no stage waits for the input.
 * Each has its images in memory, usually 1.5 MB. */
constexpr StagePipeline::Capacity kCapacity{6, 128u << 20};

std::optional<GraphOdometry> graphOf(const SlamOptions& options)
{
  if (options.odometry != PoseSource::Graph) return std::nullopt;
  return GraphOdometry(options.odometryGraph);
}

/** Name, for messages, of poses that are given. \param kind Kind of the rawlog's odometry. */
std::string nameOfGivenPoses(const SlamOptions& options, const std::string& kind)
{
  if (options.odometry == PoseSource::Graph) return "the pose graph " + options.odometryGraph;
  if (options.odometry == PoseSource::GroundTruth) return "ground truth";
  return "the rawlog's odometry" + (kind.empty() ? "" : ", " + kind);
}

/** Where up is taken from, for messages. */
const char* textOf(UpOrigin origin)
{
  switch (origin)
  {
    case UpOrigin::Floor:
      return "from the floor it sees";
    case UpOrigin::Surfaces:
      return "from horizontal and vertical surfaces: no floor seen at first";
    default:
      return "as the sensor is mounted: no floor seen at first";
  }
}

}  // namespace

ObjectSlam::ObjectSlam(
    const SlamConfiguration& configuration,
    const LabelTable& labels,
    KeyframeSpool& spool,
    const OdometrySurvey& survey,
    bool keepGoing) :
    COutputLogger("ObjectSlam"),
    configuration_(configuration),
    labels_(labels),
    spool_(spool),
    keepGoing_(keepGoing),
    selector_(configuration.keyframes),
    odometry_(
        configuration.slam.odometry,
        configuration.poses,
        configuration.visual,
        survey.up_robot,
        graphOf(configuration.slam)),
    detection_(configuration.slam),
    perception_(configuration, labels),
    backEnd_(configuration, labels_),
    tasks_(kCapacity.items),
    pipeline_(stages(), configuration.slam.workingThreads(), kCapacity)
{
  result_.odometry.upOrigin = survey.upOrigin;
  result_.map.insertionOptions = configuration.mapInsertion;
  result_.map.likelihoodOptions = configuration.mapLikelihood;
  result_.map.renderOptions = configuration.mapRender;
  result_.map.perceptionOptions = configuration.perception;
  result_.map.setLabels(labels);
  if (configuration.slam.association == AssociationSource::Given)
    result_.map.insertionOptions.useInstanceIds = true;
}

void ObjectSlam::addFrame(const RgbdFrame& frame)
{
  SlamCounts& counts = result_.countsBySensor[frame.scan->sensorLabel];
  ++counts.frames;
  const auto bad = badFrames_.size();
  if (const auto T_odom_robot = poseOf(frame))
  {
    moment_.exclude();
    addPosedFrame(frame, *T_odom_robot);
    return;
  }
  ++counts.framesWithoutPose;
  if (badFrames_.size() == bad) moment_.add(frame);
}

std::optional<CPose3D> ObjectSlam::poseOf(const RgbdFrame& frame)
{
  const auto scope = times_.measure("odometry");
  std::optional<CPose3D> T_odom_robot;
  try
  {
    T_odom_robot = odometry_.poseOf(frame);
  }
  catch (const std::exception& e)
  {
    if (!keepGoing_) throw BadFrame(frame, rootMessage(e));
    badFrames_.emplace_back(frame, rootMessage(e));
  }
  if (result_.counts().frames == 1) tellOdometry(frame);
  result_.odometry.visual = odometry_.visualCounts();
  for (const auto& text : odometry_.takeWarnings()) warnOfInput(text);
  return T_odom_robot;
}

void ObjectSlam::tellOdometry(const RgbdFrame& frame)
{
  result_.odometry.source = odometry_.source();
  result_.odometry.visualSensor = odometry_.visualSensor();
  if (odometry_.source() == PoseSource::Visual)
    MRPT_LOG_INFO_FMT(
        "poses: visual odometry of sensor %s, up %s", frame.scan->sensorLabel.c_str(),
        textOf(result_.odometry.upOrigin));
  else
    MRPT_LOG_INFO_STREAM("poses: " << nameOfGivenPoses(configuration_.slam, frame.odometryKind));
}

void ObjectSlam::addPosedFrame(const RgbdFrame& frame, const CPose3D& T_odom_robot)
{
  if (keepsUp_ && pipeline_.isFull()) return;
  const CPose3D T_odom_sensor = T_odom_robot + frame.scan->sensorPose;
  const bool isNode =
      odometry_.source() == PoseSource::Graph;  // the other program chose the keyframes
  if (!isNode && !selector_.isKeyframe(frame.scan->sensorLabel, frame.time(), T_odom_sensor))
    return;
  KeyframeTask next{frame, T_odom_robot, odometry_.keyframeStep()};
  if (frame.objects && configuration_.slam.method != SlamMethod::Odometry)
  {
    next.boxes = CObservationObjects::Create(*frame.objects);
    lookThrough(*next.boxes);
  }
  task(added_++) = std::move(next);
  pipeline_.add(imageBytesOf(*frame.scan));
  takeFinished();
}

void ObjectSlam::settle()
{
  pipeline_.finish();
  takeFinished();
}

void ObjectSlam::finish(const CQuadricObjectMap* earlier, const std::function<bool()>& shouldStop)
{
  const SlamCounts counts = result_.counts();
  if (counts.framesWithoutPose > 0 && counts.framesWithoutPose == counts.frames)
    placeFramesWithoutPose();
  else if (const auto text = odometry_.missingPoses(); !text.empty())
    warnOfInput(text + " and were left out");
  settle();
  warnOfUnknownLabels();
  requireInstanceIds();
  warnOfDoubtfulPoses();
  warnOfMissingDepth();
  warnOfDroppedFloors();
  for (const auto& line : modelShares(result_.labels)) MRPT_LOG_DEBUG_STREAM(line);
  {
    const auto scope = times_.measure("consolidation");
    backEnd_.finish([this](std::size_t k) { return spool_.objects(k); }, shouldStop, result_);
  }
  warnOfNoisyOdometry();
  warnOfOpenLoop();
  warnOfThingsNotFoundAgain();
  if (earlier) continueFrom(*earlier);
  const auto scope = times_.measure("consolidation");
  result_.map.conclude();
}

void ObjectSlam::continueFrom(const CQuadricObjectMap& map)
{
  const auto scope = times_.measure("relocalisation");
  continueMap(
      map, backEnd_.backEnd(), [this](std::size_t k) { return spool_.objects(k); },
      configuration_.relocalization, result_);
  const auto& match = result_.continuation->match;
  MRPT_LOG_INFO_FMT(
      "localised: %zu of the map's %zu objects found again (ln odds %.1f, next best place %.1f)",
      match.pairs.size(), result_.continuation->knownObjects, match.logOdds, match.secondLogOdds);
  if (result_.continuation->lostInCorrection)
    warn(
        "the map's objects could not correct the poses: where this is in the map could then no "
        "longer be told; they are those of the run alone, moved into the map");
}

void ObjectSlam::placeFramesWithoutPose()
{
  const auto& frames = moment_.frames();
  if (frames.empty() || configuration_.slam.odometry != PoseSource::Auto)
    throw std::runtime_error(odometry_.whyNoPoses());
  warnOfInput(
      frames.size() == 1
          ? "no odometry, but a single image: its robot pose is the origin of the map"
          : "no odometry, but images of a single moment: the robot pose is the origin of the map");
  for (const auto& frame : frames)
  {
    result_.countsBySensor[frame.scan->sensorLabel].framesWithoutPose = 0;
    addPosedFrame(frame, odometry_.poseOfMoment());
  }
}

void ObjectSlam::leaveOutAnonymous(CObservationObjects& boxes)
{
  for (auto& object : boxes.objects)
  {
    if (object.instanceId) continue;
    object.measurement = ObjectMeasurement();
    object.measurement.kind = MeasurementKind::Rejected;
    object.measurement.reason = "no instance id, and associations are given";
  }
}

void ObjectSlam::requireInstanceIds() const
{
  const auto boxes = result_.counts().boxes;
  if (configuration_.slam.association == AssociationSource::Given && boxes > 0 && !anyInstanceId_)
    throw std::runtime_error(mrpt::format(
        "associations should be given, but none of the %zu boxes has an instance id", boxes));
}

/** Notes what is new in the boxes of a keyframe. */
void ObjectSlam::lookThrough(const CObservationObjects& boxes)
{
  for (const auto& object : boxes.objects)
  {
    anyInstanceId_ |= object.instanceId.has_value();
    if (!labels_.properties(object.label).known) unknownLabels_.insert(object.label);
  }
}

void ObjectSlam::warnOfUnknownLabels()
{
  if (unknownLabels_.empty()) return;
  warnOfInput(
      "labels that are not in the label table: " + firstFew(unknownLabels_) +
      "; neutral properties are used");
  for (const auto& label : unknownLabels_) MRPT_LOG_DEBUG_STREAM("no known label: " << label);
}

void ObjectSlam::warnOfInput(const std::string& text)
{
  warn(inputName_.empty() ? text : inputName_ + ": " + text);
}

void ObjectSlam::warn(const std::string& text)
{
  MRPT_LOG_WARN_STREAM(text);
  result_.warnings.push_back(text);
}

}  // namespace quadmap
