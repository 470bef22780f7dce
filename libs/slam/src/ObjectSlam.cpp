#include "quadmap/slam/ObjectSlam.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "quadmap/perception/BoxEdges.h"

namespace quadmap
{
using mrpt::poses::CPose3D;

namespace
{
bool hasDepth(const mrpt::obs::CObservation3DRangeScan& scan)
{
  const auto& depth = scan.rangeImage;
  return scan.hasRangeImage &&
         std::any_of(depth.data(), depth.data() + depth.size(), [](auto d) { return d != 0; });
}

/** The map's z axis in the sensor frame. */
Eigen::Vector3d upInSensor(const CPose3D& T_map_sensor)
{
  return T_map_sensor.getRotationMatrix().asEigen().row(2).transpose();
}

/** The reason without its numbers, so that like ones are counted together. */
std::string kindOfReason(const std::string& reason)
{
  std::string kind;
  for (const char c : reason)
    if (const bool inNumber = std::isdigit(static_cast<unsigned char>(c)) ||
                              (c == '.' && !kind.empty() && kind.back() == '#');
        !inNumber)
      kind += c;
    else if (kind.empty() || kind.back() != '#')
      kind += '#';
  return kind;
}

/** A table of which model the boxes of each label became, a line each. */
std::vector<std::string> modelShares(const std::map<std::string, LabelCounts>& labels)
{
  LabelCounts all;
  std::vector<std::string> lines = {mrpt::format(
      "%-16s %6s %10s %10s %10s", "label", "boxes", "complete", "partial", "rejected")};
  const auto addLine = [&](const std::string& label, const LabelCounts& n)
  {
    const double share = n.boxes() > 0 ? 100.0 / static_cast<double>(n.boxes()) : 0.0;
    lines.push_back(mrpt::format(
        "%-16s %6zu %8.1f %% %8.1f %% %8.1f %%", label.c_str(), n.boxes(),
        share * static_cast<double>(n.complete), share * static_cast<double>(n.partial),
        share * static_cast<double>(n.rejected)));
  };
  for (const auto& [label, counts] : labels)
  {
    addLine(label, counts);
    all.complete += counts.complete;
    all.partial += counts.partial;
    all.rejected += counts.rejected;
  }
  addLine("all", all);
  return lines;
}

}  // namespace

ObjectSlam::ObjectSlam(
    const SlamConfiguration& configuration,
    const LabelTable& labels,
    KeyframeSpool& spool,
    const std::optional<Eigen::Vector3d>& up_robot) :
    COutputLogger("ObjectSlam"),
    configuration_(configuration),
    labels_(labels),
    spool_(spool),
    perception_(configuration.perception, labels),
    selector_(configuration.keyframes),
    odometry_(configuration.slam.odometry, configuration.poses, configuration.visual, up_robot),
    backEnd_(createBackEnd(configuration, labels_))
{
  result_.odometry.upFromFloor = up_robot.has_value();
  result_.map.insertionOptions = configuration.mapInsertion;
  result_.map.likelihoodOptions = configuration.mapLikelihood;
  result_.map.renderOptions = configuration.mapRender;
  result_.map.perceptionOptions = configuration.perception;
  result_.map.setLabels(labels);
}

bool ObjectSlam::addFrame(const RgbdFrame& frame)
{
  SlamCounts& counts = result_.countsBySensor[frame.scan->sensorLabel];
  ++counts.frames;
  if (const auto T_map_robot = poseOf(frame))
  {
    hasOneMoment_ = false;
    withoutPose_.clear();
    return addPosedFrame(frame, *T_map_robot);
  }
  ++counts.framesWithoutPose;
  keepWhileOneMoment(frame);
  return false;
}

void ObjectSlam::keepWhileOneMoment(const RgbdFrame& frame)
{
  constexpr double kMoment = 0.1;  // [s]
  const auto isAnother = [&](const RgbdFrame& other)
  {
    return other.scan->sensorLabel == frame.scan->sensorLabel ||
           std::abs(other.time() - frame.time()) > kMoment;
  };
  hasOneMoment_ =
      hasOneMoment_ && std::none_of(withoutPose_.begin(), withoutPose_.end(), isAnother);
  if (hasOneMoment_)
    withoutPose_.push_back(frame);
  else
    withoutPose_.clear();
}

std::optional<CPose3D> ObjectSlam::poseOf(const RgbdFrame& frame)
{
  const auto scope = times_.measure("odometry");
  const auto T_map_robot = odometry_.poseOf(frame);
  if (result_.counts().frames == 1) tellOdometry(frame);
  result_.odometry.visual = odometry_.visualCounts();
  for (const auto& text : odometry_.takeWarnings()) warn(text);
  return T_map_robot;
}

void ObjectSlam::tellOdometry(const RgbdFrame& frame)
{
  result_.odometry.source = odometry_.source();
  result_.odometry.visualSensor = odometry_.visualSensor();
  if (odometry_.source() == PoseSource::Visual)
    MRPT_LOG_INFO_FMT(
        "poses: visual odometry of sensor %s, up %s", frame.scan->sensorLabel.c_str(),
        result_.odometry.upFromFloor ? "from the floor it sees"
                                     : "as the sensor is mounted: no floor seen at first");
  else
    MRPT_LOG_INFO_STREAM(
        "poses: "
        << (odometry_.source() == PoseSource::GroundTruth ? "ground truth"
                                                          : "the rawlog's odometry"));
}

void ObjectSlam::finish()
{
  const std::size_t missing = result_.counts().framesWithoutPose;
  if (missing > 0 && missing == result_.counts().frames)
  {
    if (!hasOneMoment_ || configuration_.slam.odometry != PoseSource::Auto)
      throw std::runtime_error(odometry_.whyNoPoses());
    warn(
        missing == 1
            ? "no odometry, but a single image: its robot pose is the origin of the map"
            : "no odometry, but images of a single moment: the robot pose is the origin of "
              "the map");
    for (const auto& frame : withoutPose_)
    {
      result_.countsBySensor[frame.scan->sensorLabel].framesWithoutPose = 0;
      addPosedFrame(frame, CPose3D());
    }
  }
  else if (missing > 0)
    warn(mrpt::format(
        "%zu of %zu images have no pose and were left out", missing, result_.counts().frames));
  warnOfMissingDepth();
  for (const auto& line : modelShares(result_.labels)) MRPT_LOG_DEBUG_STREAM(line);
  correctEverything();
}

void ObjectSlam::warnOfMissingDepth()
{
  const bool several = result_.countsBySensor.size() > 1;
  for (const auto& [sensor, counts] : result_.countsBySensor)
    if (counts.keyframesWithoutDepth > 0)
      warn(mrpt::format(
          "%zu of %zu keyframes%s have no valid depth at all", counts.keyframesWithoutDepth,
          counts.keyframes, several ? (" of " + sensor).c_str() : ""));
}

void ObjectSlam::correctEverything()
{
  const auto scope = times_.measure("consolidation");
  backEnd_->finish([this](std::size_t k) { return spool_.objects(k); }, result_);
}

bool ObjectSlam::addPosedFrame(const RgbdFrame& frame, const CPose3D& T_odom_robot)
{
  const CPose3D T_odom_sensor = T_odom_robot + frame.scan->sensorPose;
  if (!selector_.isKeyframe(frame.scan->sensorLabel, frame.time(), T_odom_sensor)) return false;
  const CPose3D predicted = backEnd_->predict(T_odom_robot);

  CObservationObjects::Ptr boxes;
  if (frame.objects && configuration_.slam.method != SlamMethod::Odometry)
  {
    boxes = CObservationObjects::Create(*frame.objects);
    measureBoxes(frame, *boxes, predicted + frame.scan->sensorPose);
  }
  {
    const auto scope = times_.measure("spool");
    spool_.append(*frame.scan, boxes.get());
  }
  const auto step = odometry_.keyframeStep();
  const CPose3D T_map_robot = insertIntoMap(boxes.get(), step, T_odom_robot);
  SlamCounts& counts = result_.countsBySensor[frame.scan->sensorLabel];
  ++counts.keyframes;
  if (boxes) counts.boxes += boxes->objects.size();
  if (!frame.objects) ++counts.keyframesWithoutBoxes;
  if (frame.objectsFromPixelLabels) ++counts.keyframesFromPixelLabels;
  if (!hasDepth(*frame.scan)) ++counts.keyframesWithoutDepth;
  MRPT_LOG_DEBUG_FMT(
      "keyframe %zu: record %zu (%s), %zu boxes, %zu objects in the map", result_.keyframes.size(),
      frame.record, frame.scan->sensorLabel.c_str(), boxes ? boxes->objects.size() : 0,
      result_.map.objects().size());
  result_.keyframes.push_back(
      {frame.record, frame.scan->sensorLabel, frame.time(), T_map_robot, T_odom_robot, step});
  return true;
}

void ObjectSlam::measureBoxes(
    const RgbdFrame& frame, CObservationObjects& boxes, const CPose3D& T_map_sensor)
{
  warnOfUnknownLabels(boxes);
  const auto scope = times_.measure("perception");
  try
  {
    if (configuration_.slam.method == SlamMethod::Quadric)
    {
      measureWithoutDepth(boxes, configuration_.perception);
      return;
    }
    const auto surfaces = perception_.measure(
        *frame.scan, boxes, upInSensor(T_map_sensor), room_.around(T_map_sensor));
    room_.add(surfaces, T_map_sensor);
  }
  catch (const std::runtime_error& e)
  {
    throw BadFrame(e.what());
  }
}

CPose3D ObjectSlam::insertIntoMap(
    const CObservationObjects* boxes,
    const std::optional<mrpt::poses::CPose3DPDFGaussian>& step,
    const CPose3D& T_odom_robot)
{
  const auto scope = times_.measure("map");
  if (boxes) count(*boxes);
  return backEnd_->addKeyframe(T_odom_robot, step, boxes, result_);
}

void ObjectSlam::count(const CObservationObjects& boxes)
{
  for (const auto& object : boxes.objects)
  {
    LabelCounts& counts = result_.labels[labels_.canonical(object.label)];
    std::string kind = "rejected";
    switch (object.measurement.kind)
    {
      case MeasurementKind::Complete:
        ++counts.complete;
        kind = "complete";
        break;
      case MeasurementKind::Partial:
        ++counts.partial;
        kind = "partial";
        break;
      default:
        ++counts.rejected;
    }
    ++counts.reasons[kind + ": " + kindOfReason(object.measurement.reason)];
  }
}

void ObjectSlam::warnOfUnknownLabels(const CObservationObjects& boxes)
{
  for (const auto& object : boxes.objects)
    if (!labels_.properties(object.label).known && unknownLabels_.insert(object.label).second)
      warn("label \"" + object.label + "\" is not in the label table: neutral properties are used");
}

void ObjectSlam::warn(const std::string& text)
{
  MRPT_LOG_WARN_STREAM(text);
  result_.warnings.push_back(text);
}

}  // namespace quadmap
