#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "files/EstimationJson.h"
#include "files/ResultWriter.h"
#include "quadmap/base/Json.h"
#include "quadmap/base/OutputFile.h"

namespace quadmap
{
namespace
{
std::string odometryText(const RunRecord& run)
{
  const OdometrySummary& odometry = run.result.odometry;
  if (odometry.source == PoseSource::Visual) return "visual odometry " + odometry.visualSensor;
  if (odometry.source == PoseSource::Graph)
    return "pose graph " + run.configuration.slam.odometryGraph;
  return odometry.source == PoseSource::GroundTruth ? "ground truth" : run.input.odometryKind;
}

Json countsJson(const SlamCounts& counts)
{
  return {
      {                     "frames",                   counts.frames},
      {        "frames_without_pose",        counts.framesWithoutPose},
      {                  "keyframes",                counts.keyframes},
      {    "keyframes_without_boxes",    counts.keyframesWithoutBoxes},
      {    "keyframes_without_depth",    counts.keyframesWithoutDepth},
      {"keyframes_from_pixel_labels", counts.keyframesFromPixelLabels},
      {                      "boxes",                    counts.boxes}
  };
}

Json inputJson(const RunRecord& run, std::size_t poses)
{
  Json sensors = Json::object();
  for (const auto& [label, counts] : run.result.countsBySensor) sensors[label] = countsJson(counts);
  Json json = {
      {        "file",        run.input.file},
      {"objects_file", run.input.objectsFile},
      {      "sensor", run.input.sensorLabel},
      {     "records",     run.input.records},
      {    "odometry",     odometryText(run)},
      { "interrupted", run.input.interrupted},
  };
  json.update(countsJson(run.result.counts()));
  json["poses"] = poses;
  json["sensors"] = sensors;
  return json;
}

const char* nameOf(UpOrigin origin)
{
  switch (origin)
  {
    case UpOrigin::Floor:
      return "floor seen";
    case UpOrigin::Surfaces:
      return "horizontal and vertical surfaces";
    default:
      return "sensor pose";
  }
}

/** Figures of visual odometry, or null when it was not used. */
Json visualOdometryJson(const OdometrySummary& odometry)
{
  if (!odometry.visual) return nullptr;
  const VisualOdometryCounts& counts = *odometry.visual;
  return {
      {        "sensor",     odometry.visualSensor},
      {            "up", nameOf(odometry.upOrigin)},
      {        "frames",             counts.frames},
      {       "by_flow",             counts.byFlow},
      {"by_descriptors",      counts.byDescriptors},
      {        "failed",             counts.failed},
      {     "keyframes",          counts.keyframes},
      {          "gaps",               counts.gaps}
  };
}

/** Numbers and flags as such, three numbers as a list, and everything else as text. */
Json jsonOf(const Option& option)
{
  std::string text = option.text();
  const bool isNumber = option.bounds.min < option.bounds.max;
  if (!isNumber && option.range != "true or false") return text;
  if (text.find(' ') == std::string::npos) return Json::parse(text);
  std::replace(text.begin(), text.end(), ' ', ',');
  return Json::parse("[" + text + "]");
}

Json configurationJson(const SlamConfiguration& configuration)
{
  Json json = Json::object();
  configuration.visitOptions([&](const std::string& section, const Option& option)
                             { json[section][option.key] = jsonOf(option); });
  json["slam"].erase("threads");  // only times depend on it, and it is written with them
  return json;
}

/** Shares of a label's boxes that became each kind of measurement, in [0, 1]. */
Json sharesJson(const LabelCounts& counts)
{
  const auto share = [&](std::size_t n)
  { return rounded(static_cast<double>(n) / static_cast<double>(counts.boxes()), 4); };
  return {
      {"complete", share(counts.complete)},
      { "partial",  share(counts.partial)},
      {"rejected", share(counts.rejected)}
  };
}

Json boxesJson(const SlamResult& result)
{
  Json labels = Json::object();
  for (const auto& [label, counts] : result.labels)
    labels[label] = {
        {"complete",    counts.complete},
        { "partial",     counts.partial},
        {"rejected",    counts.rejected},
        {  "shares", sharesJson(counts)},
        { "reasons",     counts.reasons}
    };
  return {
      {   "total", result.counts().boxes},
      {"by_label",                labels}
  };
}

Json problemsJson(const std::vector<InputProblem>& problems)
{
  Json json = Json::array();
  for (const auto& p : problems)
    json.push_back({
        {  "file",   p.file},
        {"record", p.record},
        {"sensor", p.sensor},
        {  "what",   p.what}
    });
  return json;
}

Json timingJson(const RunRecord& run)
{
  Json modules = Json::object();
  for (const auto& [name, t] : run.times.summaries())
    modules[name] = {
        {      "calls",           t.calls},
        { "cpu_mean_ms", rounded(t.mean_ms,           3)},
        { "cpu_p95_ms",  rounded(t.p95_ms,           3)},
        { "cpu_total_s", rounded(t.total_s,           3)}
    };
  return {
      {       "threads", run.configuration.slam.workingThreads()},
      { "modules",                                 modules               },
      { "cpu_total_s",                rounded(processCpuTime(),                                                     3)},
      { "peak_memory_mb",                 rounded(peakMemory_mb(),                                                     1)}
  };
}

/** Writes one line per keyframe with boxes. They are many, so none is kept in memory. */
class AssociationLines
{
 public:
  AssociationLines(std::ostream& out, const std::vector<PoseNode>& nodes, const RunRecord& run) :
      out_(out), run_(run), poseOf_(nodeOfEachKeyframe(nodes))
  {
  }

  void write()
  {
    for (std::size_t k = 0; k < run_.result.keyframes.size(); ++k)
    {
      const auto boxes = run_.spool.objects(k);
      if (!boxes) continue;
      out_ << (anyLine_ ? ",\n    " : "\n    ") << jsonText(keyframeJson(k, *boxes));
      anyLine_ = true;
    }
  }

 private:
  Json keyframeJson(std::size_t k, const CObservationObjects& boxes)
  {
    const Keyframe& keyframe = run_.result.keyframes[k];
    Json list = Json::array();
    for (const auto& box : boxes.objects)
      list.push_back({
          { "label",                    box.label},
          {  "kind", nameOf(box.measurement.kind)},
          {"reason",       box.measurement.reason},
          {"object",                       Json()}
      });
    const auto& decisions = run_.result.decisions;
    for (; next_ < decisions.size() && decisions[next_].keyframe == k; ++next_)
      addDecision(list.at(decisions[next_].decision.box), decisions[next_].decision);
    return {
        {"keyframe",                     k},
        {    "pose",            poseOf_[k]},
        {  "record",       keyframe.record},
        {  "sensor",       keyframe.sensor},
        {    "time", rounded(keyframe.time,6)},
        {   "boxes",                  list                     }
    };
  }

  static void addDecision(Json& box, const CQuadricObjectMap::Decision& decision)
  {
    if (decision.object) box["object"] = *decision.object;
    box["started_object"] = decision.startedObject;
    box["log_posterior"] = rounded(decision.logPosterior, 4);
    box["log_posterior_second"] = rounded(decision.logPosteriorSecond, 4);
  }

  std::ostream& out_;
  const RunRecord& run_;
  std::vector<std::size_t> poseOf_;  //!< Node of each keyframe
  std::size_t next_ = 0;             //!< Index of the next decision
  bool anyLine_ = false;
};

}  // namespace

void writeReport(const std::string& path, const std::vector<PoseNode>& nodes, const RunRecord& run)
{
  const Json head = {
      {         "format",                         "quadmap-report"},
      {        "version",                                        1},
      {        "program",                           "quadmap-slam"},
      {"program_version",                              run.version},
      {          "input",                            inputJson(run,nodes.size())},
      {  "configuration",     configurationJson(run.configuration)                                        },
      {"visual_odometry",  visualOdometryJson(run.result.odometry)},
      {          "boxes",                    boxesJson(run.result)                                        },
      {        "objects", run.result.map.confirmedObjects().size()},
      { "dropped_floors",                 run.result.droppedFloors                                        },
      {     "correction",    correctionJson(run.result.correction)},
      {          "loops",              loopsJson(run.result.loops)                                        },
      {    "map_changes",  mapChangesJson(run.result.continuation)},
      {       "warnings",                      run.result.warnings                                        },
      {        "dropped",         problemsJson(run.input.problems)},
      {         "timing",                          timingJson(run)                                        }
  };
  std::string start = jsonText(head, 2);
  start.erase(start.rfind('\n'));  // the closing brace comes after the associations

  OutputFile file(path);
  std::ofstream out(file.temporaryPath());
  out << start << ",\n  \"associations\": [";
  AssociationLines(out, nodes, run).write();
  out << "\n  ]\n}\n";
  out.close();
  if (!out) file.fail();
  file.commit();
}

}  // namespace quadmap
