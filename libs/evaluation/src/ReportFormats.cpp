#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "quadmap/base/Json.h"
#include "quadmap/evaluation/EvaluationReport.h"

namespace quadmap
{
namespace
{
std::optional<double> degrees(const std::optional<double>& radians)
{
  if (!radians) return std::nullopt;
  return mrpt::RAD2DEG(*radians);
}

/** The id as objects.json has it: a number when it is one. */
Json idOf(const ObjectRecord& object)
{
  const std::string& id = object.id;
  const bool isNumber =
      !id.empty() && id.size() < 10 && (id[0] != '0' || id.size() == 1) &&
      std::all_of(id.begin(), id.end(), [](char c) { return c >= '0' && c <= '9'; });
  return isNumber ? Json(std::stol(id)) : Json(id);
}

Json trajectoryJson(const EvaluationReport& report)
{
  const auto& t = report.trajectory;
  return {
      {         "ate_rmse_m",           t ? Json(t->ateRmse) : Json()},
      {"ate_rmse_odometry_m", t ? orNull(t->ateRmseOdometry) : Json()},
      {          "keyframes",             t ? Json(t->pairs) : Json()}
  };
}

Json objectsJson(const EvaluationReport& report)
{
  const ObjectEvaluation o = report.objects.value_or(ObjectEvaluation());
  const auto count = [&](std::size_t n) { return report.objects ? Json(n) : Json(); };
  return {
      {      "truth",          count(o.truthCount())},
      {  "estimated",      count(o.estimatedCount())},
      {    "matched",        count(o.matches.size())},
      {  "precision",          orNull(o.precision())},
      {     "recall",             orNull(o.recall())},
      {         "f1",                 orNull(o.f1())},
      {    "trans_m", orNull(o.meanCenterDistance())},
      {    "rot_deg", orNull(degrees(o.meanAngle()))},
      {  "shape_iou",       orNull(o.meanShapeIoU())},
      {     "iou_3d",          orNull(o.meanIoU3d())},
      {"nees_center",     orNull(o.meanCenterNees())},
      {"nees_height",     orNull(o.meanHeightNees())},
      {   "nees_yaw",        orNull(o.meanYawNees())}
  };
}

Json matchesJson(const EvaluationReport& report)
{
  Json list = Json::array();
  if (!report.objects) return list;
  for (const auto& [truth, estimated, c] : report.objects->matches)
    list.push_back({
        {   "truth_id",              idOf(truth)},
        {         "id",          idOf(estimated)},
        {      "label",              truth.label},
        {    "trans_m",         c.centerDistance},
        {    "rot_deg", orNull(degrees(c.angle))},
        {  "shape_iou",               c.shapeIoU},
        {     "iou_3d",                  c.iou3d},
        {"nees_center",     orNull(c.centerNees)},
        {"nees_height",     orNull(c.heightNees)},
        {   "nees_yaw",        orNull(c.yawNees)}
    });
  return list;
}

Json selfJson(const SelfCheck& self)
{
  Json list = Json::array();
  for (const SelfCheckedObject& o : self.objects)
  {
    ObjectRecord named;
    named.id = o.id;
    list.push_back({
        {        "id",         idOf(named)},
        {     "label",             o.label},
        {    "points",            o.points},
        {"on_surface", orNull(o.onSurface)},
        {    "inside",    orNull(o.inside)},
        {    "beyond",    orNull(o.beyond)},
        {      "rays",              o.rays},
        {   "through",   orNull(o.through)}
    });
  }
  return {
      {"on_surface", orNull(self.meanOnSurface())},
      {    "inside",    orNull(self.meanInside())},
      {    "beyond",    orNull(self.meanBeyond())},
      {   "through",   orNull(self.meanThrough())},
      {   "objects",                         list}
  };
}

std::string orDash(const std::optional<double>& value, const char* format)
{
  return value ? mrpt::format(format, *value) : "-";
}

/** One row of the table of matches, or its heading. */
std::string row(const std::string& label, const std::string& ids, const std::string (&figures)[4])
{
  return mrpt::format(
      "  %-16s %-14s %9s %9s %9s %9s\n", label.c_str(), ids.c_str(), figures[0].c_str(),
      figures[1].c_str(), figures[2].c_str(), figures[3].c_str());
}

std::string trajectoryTable(const TrajectoryEvaluation& t)
{
  return mrpt::format(
      "Trajectory: ATE RMSE %.4f m over %zu of %zu poses; odometry alone %s\n", t.ateRmse, t.pairs,
      t.poses, t.ateRmseOdometry ? mrpt::format("%.4f m", *t.ateRmseOdometry).c_str() : "-");
}

std::string objectList(const char* title, const std::vector<ObjectRecord>& objects)
{
  if (objects.empty()) return {};
  std::vector<const ObjectRecord*> sorted;
  for (const auto& object : objects) sorted.push_back(&object);
  std::stable_sort(
      sorted.begin(), sorted.end(),
      [](const ObjectRecord* a, const ObjectRecord* b) { return a->label < b->label; });
  std::string text = mrpt::format("%s:\n", title);
  for (const ObjectRecord* object : sorted)
  {
    const Eigen::Vector3d c = object->object.center(), size = 2 * object->object.semiAxes();
    text += mrpt::format(
        "  %-16s %-14s at (%.2f, %.2f, %.2f) m, %.2f x %.2f x %.2f m\n", object->label.c_str(),
        object->id.c_str(), c.x(), c.y(), c.z(), size.x(), size.y(), size.z());
  }
  return text;
}

std::string objectsTable(const ObjectEvaluation& o)
{
  std::string text = mrpt::format(
      "Objects: %zu true, %zu estimated, %zu matched; precision %s, recall %s, F1 %s\n",
      o.truthCount(), o.estimatedCount(), o.matches.size(), orDash(o.precision(), "%.3f").c_str(),
      orDash(o.recall(), "%.3f").c_str(), orDash(o.f1(), "%.3f").c_str());
  if (!o.matches.empty())
  {
    text += row("label", "true = found", {"Trans[m]", "Rot[deg]", "Shape IoU", "3-D IoU"});
    for (const auto& [truth, estimated, c] : o.matches)
      text +=
          row(truth.label, truth.id + " = " + estimated.id,
              {mrpt::format("%.3f", c.centerDistance), orDash(degrees(c.angle), "%.2f"),
               mrpt::format("%.3f", c.shapeIoU), mrpt::format("%.3f", c.iou3d)});
    text +=
        row("mean", "",
            {orDash(o.meanCenterDistance(), "%.3f"), orDash(degrees(o.meanAngle()), "%.2f"),
             orDash(o.meanShapeIoU(), "%.3f"), orDash(o.meanIoU3d(), "%.3f")});
    if (o.meanCenterNees())
      text += mrpt::format(
          "Squared errors over the claimed variances: centre %.2f (3 expected), height %.2f (1), "
          "yaw "
          "%s (1)\n",
          *o.meanCenterNees(), *o.meanHeightNees(), orDash(o.meanYawNees(), "%.2f").c_str());
  }
  text += objectList("Missed", o.missed);
  text += objectList("False", o.spurious);
  text += objectList("Not found, but seen in too few frames to count", o.uncounted);
  return text;
}
std::string selfTable(const SelfCheck& self)
{
  std::string text =
      "Against the depth images, shares in percent: of an object's points those on its surface, "
      "inside and\nbeyond it; of the rays into it those that go through\n";
  const auto figures =
      [&](const std::string& label, const std::string& id, const std::optional<double>(&shares)[4])
  {
    std::string out[4];
    for (std::size_t i = 0; i < 4; ++i)
      out[i] = shares[i] ? mrpt::format("%.1f", 100 * *shares[i]) : "-";
    text += row(label, id, out);
  };
  text += row("label", "id", {"surface", "inside", "beyond", "through"});
  for (const SelfCheckedObject& o : self.objects)
    figures(o.label, o.id, {o.onSurface, o.inside, o.beyond, o.through});
  figures(
      "mean", "", {self.meanOnSurface(), self.meanInside(), self.meanBeyond(), self.meanThrough()});
  return text;
}
}  // namespace

std::string toJson(const EvaluationReport& report)
{
  Json json{
      {    "format",   "quadmap-evaluation"},
      {   "version",                      1},
      {"trajectory", trajectoryJson(report)},
      {   "objects",    objectsJson(report)},
      {   "matches",    matchesJson(report)}
  };
  if (report.self) json["self"] = selfJson(*report.self);
  return jsonText(json, 2) + "\n";
}

std::string toTable(const EvaluationReport& report)
{
  std::string text;
  for (const auto& note : report.notes) text += "Note: " + note + "\n";
  if (report.trajectory) text += trajectoryTable(*report.trajectory);
  if (report.objects) text += objectsTable(*report.objects);
  if (report.self) text += selfTable(*report.self);
  return text;
}

}  // namespace quadmap
