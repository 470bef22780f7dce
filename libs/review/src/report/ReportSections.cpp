#include "ReportSections.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "Html.h"

namespace quadmap
{
namespace
{
constexpr const char* kNothing = "-";

/** What stands at a path of keys; null when something on the way is missing. */
Json at(const Json& json, const std::vector<std::string>& path)
{
  const Json* value = &json;
  for (const std::string& key : path)
  {
    if (!value->is_object() || !value->contains(key)) return {};
    value = &value->at(key);
  }
  return *value;
}

std::string text(const Json& value)
{
  if (value.is_null() || value == "") return kNothing;
  return value.is_string() ? value.get<std::string>() : jsonText(value);
}

std::string text(const Json& json, const std::vector<std::string>& path)
{
  return text(at(json, path));
}

double number(const Json& value) { return value.is_number() ? value.get<double>() : 0.0; }

std::string formatted(const std::optional<double>& value, const char* format)
{
  return value ? mrpt::format(format, *value) : kNothing;
}

/** What can be gone through by key and value; empty for anything else. */
Json objectOrEmpty(const Json& value) { return value.is_object() ? value : Json::object(); }

Json arrayOrEmpty(const Json& value) { return value.is_array() ? value : Json::array(); }

/** Reasons of boxes that did not become complete measurements: how often, and of which labels. */
struct ReasonCount
{
  std::uint64_t count = 0;
  std::string labels;
};

std::map<std::string, ReasonCount> reasonsOf(const Json& byLabel)
{
  std::map<std::string, ReasonCount> reasons;
  for (const auto& [label, counts] : byLabel.items())
  {
    const Json counted = objectOrEmpty(at(counts, {"reasons"}));
    for (const auto& [reason, count] : counted.items())
    {
      if (reason.rfind("complete", 0) == 0 || !count.is_number_unsigned()) continue;
      ReasonCount& sum = reasons[reason];
      sum.count += count.get<std::uint64_t>();
      sum.labels += (sum.labels.empty() ? "" : ", ") + label + " " + jsonText(count);
    }
  }
  return reasons;
}

std::string fileName(const std::string& path)
{
  return std::filesystem::path(path).filename().string();
}

/** Square root of the largest variance of the centre along an axis of the map [m]. */
std::string centreSigma(const ObjectRecord& object)
{
  if (!object.covariance) return kNothing;
  return mrpt::format(
      "%.3f", std::sqrt(std::max(0.0, object.covariance->diagonal().head<3>().maxCoeff())));
}

}  // namespace

std::string runSection(const Json& report)
{
  HtmlTable table({"", ""});
  const auto row = [&](const char* name, const std::vector<std::string>& path) {
    table.addRow({name, text(report, path)});
  };
  // Pages are passed on: in whose folder the recording was is for report.json.
  table.addRow({"recording", fileName(text(report, {"input", "file"}))});
  row("odometry", {"input", "odometry"});
  row("method", {"configuration", "slam", "method"});
  row("frames", {"input", "frames"});
  row("frames without a pose", {"input", "frames_without_pose"});
  row("keyframes", {"input", "keyframes"});
  row("keyframes without boxes", {"input", "keyframes_without_boxes"});
  row("boxes", {"boxes", "total"});
  row("objects", {"objects"});
  row("rounds of the correction", {"correction", "rounds"});
  row("last move of a keyframe [m]", {"correction", "last_move_m"});
  row("converged", {"correction", "converged"});
  row("odometry errs by, in positions [times what it claims]",
      {"correction", "odometry_noise", "position"});
  row("odometry errs by, in angles [times what it claims]",
      {"correction", "odometry_noise", "angle"});
  return table.toHtml();
}

std::string truthSection(const ReportTruth& truth)
{
  std::string html = "<h2>Against the truth</h2>\n";
  HtmlTable table({"", "#before", "#after"});
  if (const auto& t = truth.figures.trajectory)
    table.addRow(
        {"ATE RMSE [m]", formatted(t->ateRmseOdometry, "%.4f"), mrpt::format("%.4f", t->ateRmse)});
  if (const auto& o = truth.figures.objects)
  {
    const auto row = [&](const char* name, const std::string& value) {
      table.addRow({name, "", value});
    };
    row("true objects", std::to_string(o->truthCount()));
    row("found", std::to_string(o->matches.size()));
    row("invented", std::to_string(o->spurious.size()));
    row("precision", formatted(o->precision(), "%.2f"));
    row("recall", formatted(o->recall(), "%.2f"));
    row("F1", formatted(o->f1(), "%.2f"));
    row("centre off by [m]", formatted(o->meanCenterDistance(), "%.3f"));
    const auto angle = o->meanAngle();
    row("turned by [deg]", angle ? mrpt::format("%.1f", mrpt::RAD2DEG(*angle)) : kNothing);
    row("shape IoU", formatted(o->meanShapeIoU(), "%.2f"));
  }
  html += table.toHtml();
  for (const std::string& note : truth.figures.notes) html += htmlElement("p", note);
  return html;
}

std::string warningSection(const Json& report)
{
  std::string html = "<h2>Warnings</h2>\n";
  std::string items;
  for (const Json& warning : arrayOrEmpty(at(report, {"warnings"})))
    items += htmlElement("li", text(warning));
  html += items.empty() ? "<p>None.</p>\n" : "<ul class=\"bad\">\n" + items + "</ul>\n";
  HtmlTable dropped({"left out", "#record", "sensor", "why"});
  for (const Json& what : arrayOrEmpty(at(report, {"dropped"})))
    dropped.addRow(
        {fileName(text(what, {"file"})), text(what, {"record"}), text(what, {"sensor"}),
         text(what, {"what"})});
  return dropped.isEmpty() ? html : html + dropped.toHtml();
}

std::string boxSection(const Json& report)
{
  const Json byLabel = objectOrEmpty(at(report, {"boxes", "by_label"}));
  HtmlTable kinds({"label", "#complete", "#partial", "#rejected"});
  for (const auto& [label, counts] : byLabel.items())
    kinds.addRow(
        {label, text(counts, {"complete"}), text(counts, {"partial"}), text(counts, {"rejected"})});
  HtmlTable why(
      {"why a box was rejected, or gave no cuboid (partial)", "#boxes", "of which labels"});
  const auto reasons = reasonsOf(byLabel);
  std::vector<std::pair<std::string, ReasonCount>> ranked(reasons.begin(), reasons.end());
  const auto rank = [](const auto& reason) {
    return std::pair{reason.first.rfind("rejected", 0) == 0, reason.second.count};
  };
  std::stable_sort(
      ranked.begin(), ranked.end(),
      [&](const auto& a, const auto& b) { return rank(a) > rank(b); });
  for (const auto& [reason, sum] : ranked)
    why.addRow({reason, std::to_string(sum.count), sum.labels});
  const bool hasNumbers = std::any_of(
      ranked.begin(), ranked.end(),
      [](const auto& reason) { return reason.first.find('#') != std::string::npos; });
  return "<h2>What became of the boxes</h2>\n" + (why.isEmpty() ? "" : why.toHtml()) +
         (hasNumbers ? htmlElement("p", "# stands for a number that differs from box to box.")
                     : "") +
         kinds.toHtml();
}

std::string objectSection(const std::vector<ObjectRecord>& objects)
{
  HtmlTable table(
      {"#id", "label", "#x [m]", "#y [m]", "#z [m]", "#sigma [m]", "#size [m]", "#yaw [deg]",
       "#seen", "#exists"});
  for (const ObjectRecord& o : objects)
  {
    const Eigen::Vector3d c = o.object.center(), size = 2 * o.object.semiAxes();
    const double yaw_deg = mrpt::RAD2DEG(o.object.pose().yaw());
    table.addRow(
        {o.id, o.label, mrpt::format("%.3f", c.x()), mrpt::format("%.3f", c.y()),
         mrpt::format("%.3f", c.z()), centreSigma(o),
         mrpt::format("%.2f × %.2f × %.2f", size.x(), size.y(), size.z()),
         o.orientationDefined ? mrpt::format("%.1f", yaw_deg) : kNothing,
         o.observations ? std::to_string(*o.observations) : kNothing,
         formatted(o.existence, "%.2f")});
  }
  return "<h2>Objects</h2>\n" + (table.isEmpty() ? "<p>None.</p>\n" : table.toHtml());
}

std::string timeSection(const Json& report)
{
  const Json modules = objectOrEmpty(at(report, {"timing", "modules"}));
  double most = 0;
  for (const auto& [name, times] : modules.items())
    most = std::max(most, number(at(times, {"cpu_total_s"})));
  constexpr double kBar = 160;  // length of the longest bar [px]
  std::string rows;
  for (const auto& [name, times] : modules.items())
  {
    const double seconds = number(at(times, {"cpu_total_s"}));
    rows += "<tr><td>" + htmlText(name) + "</td>";
    for (const char* key : {"calls", "cpu_mean_ms", "cpu_p95_ms", "cpu_total_s"})
      rows += "<td class=\"number\">" + htmlText(text(times, {key})) + "</td>";
    rows += mrpt::format(
        "<td><svg width=\"%.0f\" height=\"10\"><rect class=\"bar\" width=\"%.1f\" height=\"10\"/>"
        "</svg></td></tr>\n",
        kBar, most > 0 ? kBar * seconds / most : 0.0);
  }
  return "<h2>Time per module</h2>\n<p>" + htmlText(text(report, {"timing", "cpu_total_s"})) +
         " s of CPU time until report.json was written, before the scene and this page; " +
         htmlText(text(report, {"timing", "threads"})) + " threads, " +
         htmlText(text(report, {"timing", "peak_memory_mb"})) +
         " MB of memory at most.</p>\n<div class=\"wide\"><table>\n<thead><tr><th>module</th>"
         "<th class=\"number\">calls</th><th class=\"number\">mean [ms]</th>"
         "<th class=\"number\">95 % within [ms]</th><th class=\"number\">total [s]</th><th></th>"
         "</tr></thead>\n<tbody>\n" +
         rows + "</tbody></table></div>\n";
}

}  // namespace quadmap
