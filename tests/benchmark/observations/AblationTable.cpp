#include "AblationTable.h"

#include <mrpt/core/format.h>

#include <cmath>
#include <limits>
#include <list>
#include <map>

#include "FrameMeasurer.h"
#include "MeanAndSpread.h"
#include "quadmap/evaluation/ObjectEvaluation.h"
#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/sensors/KeyframeSelector.h"

namespace quadmap::observations
{
namespace
{
struct Setting
{
  std::string name;
  PerceptionOptions options;
};

std::vector<Setting> settings()
{
  std::vector<Setting> out;
  const auto add = [&](const char* name, ObservationModels models, bool border, bool occlusion)
  {
    out.push_back({name, {}});
    PerceptionOptions& options = out.back().options;
    options.models = models;
    if (!border) options.borderMargin = 0;
    if (!occlusion) options.maxHiddenProbability = 1;
  };
  using Models = ObservationModels;
  add("both", Models::Both, true, true);
  add("only complete", Models::Complete, true, true);
  add("only partial", Models::Partial, true, true);
  add("both, no border rule", Models::Both, false, true);
  add("both, no occlusion rule", Models::Both, true, false);
  add("both, neither rule", Models::Both, false, false);
  add("only partial, no border rule", Models::Partial, false, true);
  add("only partial, no occlusion rule", Models::Partial, true, false);
  add("only partial, neither rule", Models::Partial, false, false);
  return out;
}

struct Figures
{
  MeanAndSpread trans, rot, shape, iou, precision, recall, f1;

  void add(const ObjectEvaluation& e)
  {
    trans.add(e.meanCenterDistance());
    if (const auto angle = e.meanAngle()) rot.add(*angle * 180 / M_PI);
    shape.add(e.meanShapeIoU());
    iou.add(e.meanIoU3d());
    precision.add(e.precision());
    recall.add(e.recall());
    f1.add(e.f1());
  }

  /** The means that exist, under the names quadmap-evaluate gives them. */
  std::map<std::string, double> means() const
  {
    std::map<std::string, double> out;
    const std::pair<const char*, const MeanAndSpread*> all[] = {
        {  "trans_m",     &trans},
        {  "rot_deg",       &rot},
        {"shape_iou",     &shape},
        {   "iou_3d",       &iou},
        {"precision", &precision},
        {   "recall",    &recall},
        {       "f1",        &f1}
    };
    for (const auto& [name, values] : all)
      if (const auto mean = values->mean()) out[name] = *mean;
    return out;
  }
};

/** The maps of all settings while one seed is walked through. */
class Walk
{
 public:
  Walk(const std::vector<Setting>& settings, const LabelTable& labels, bool everyFrame) :
      selector_(KeyframeOptions())
  {
    for (const auto& s : settings) runs_.emplace_back(s.options, labels);
    everyFrame_ = everyFrame;
  }

  void add(const ObservedFrame& frame)
  {
    for (const auto& seen : frame.simulated.visible) ++framesVisible_[seen.object];
    const auto& scan = *frame.simulated.scan;
    const double time = mrpt::Clock::toDouble(scan.timestamp);
    if (!everyFrame_ && !selector_.isKeyframe(scan.sensorLabel, time, frame.T_map_sensor)) return;
    for (auto& run : runs_)
      run.map.insertObservation(run.measurer.measure(frame), frame.T_map_sensor);
  }

  /** \param figures Of each setting, in their order. */
  void evaluate(const simulator::Scene& scene, std::vector<Figures>& figures)
  {
    std::vector<ObjectRecord> truth;
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
    {
      if (scene.objects[i].label.empty()) continue;
      ObjectRecord record;
      record.label = scene.objects[i].label;
      record.object = scene.objects[i].truth();
      record.orientationDefined = scene.objects[i].orientationDefined;
      record.framesVisible = framesVisible_[i];
      truth.push_back(std::move(record));
    }
    std::size_t k = 0;
    for (auto& run : runs_)
    {
      run.map.consolidate();
      figures[k++].add(evaluateObjects(truth, run.map.toRecords(), mrpt::poses::CPose3D()));
    }
  }

 private:
  struct Run
  {
    Run(const PerceptionOptions& options, const LabelTable& labels) : measurer(options, labels)
    {
      map.setLabels(labels);
    }
    FrameMeasurer measurer;
    CQuadricObjectMap map;
  };
  std::list<Run> runs_;
  KeyframeSelector selector_;
  bool everyFrame_ = false;
  std::map<std::size_t, unsigned> framesVisible_;  // by index in the scene
};

}  // namespace

Rows printAblationTable(const RunOptions& run, std::ostream& out)
{
  const auto labels = LabelTable::installed();
  const auto all = settings();
  const auto scene = simulator::readScene(simulator::findScene(run.scene));
  std::vector<Figures> figures(all.size());
  for (const auto seed : run.seeds)
  {
    RunOptions one = run;
    one.seeds = {seed};
    Walk walk(all, labels, run.framesStep > 1);
    runScene(
        one, PerceptionOptions(), labels, [&](const ObservedFrame& frame) { walk.add(frame); });
    walk.evaluate(scene, figures);
  }
  out << mrpt::format(
      "%-32s %-18s %-14s %-16s %-16s %-16s %-16s %-16s\n", "setting", "Trans [m]", "Rot [deg]",
      "Shape IoU", "3-D IoU", "precision", "recall", "F1");
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const Figures& f = figures[i];
    out << mrpt::format(
        "%-32s %-18s %-14s %-16s %-16s %-16s %-16s %-16s\n", all[i].name.c_str(),
        f.trans.text(3).c_str(), f.rot.text(2).c_str(), f.shape.text(3).c_str(),
        f.iou.text(3).c_str(), f.precision.text(2).c_str(), f.recall.text(2).c_str(),
        f.f1.text(3).c_str());
  }
  Rows rows;
  for (std::size_t i = 0; i < all.size(); ++i) rows.push_back({all[i].name, figures[i].means()});
  return rows;
}

}  // namespace quadmap::observations
