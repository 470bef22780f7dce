#include "quadmap/review/ReportPage.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "Html.h"
#include "ReportPlots.h"
#include "ReportSections.h"
#include "page/Base64.h"
#include "quadmap/base/Json.h"
#include "quadmap/base/Sha256.h"
#include "quadmap/evaluation/TrajectoryAlignment.h"

namespace quadmap
{
namespace
{
/** Colours by the reader's theme. The plots, which have their own for files, take them over. */
constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --back: #fbfbf9; --text: #1d2126; --dim: #5a606b; --line: #d6d8dc; --bar: #2b7de0; --bad: #b02020; }
@media (prefers-color-scheme: dark) { :root { --back: #16181c; --text: #e7e9ec; --dim: #9aa3ad; --line: #3a3e46; --bar: #4c94ec; --bad: #ff8a8a; } }
body { background: var(--back); color: var(--text); font: 15px/1.45 system-ui, sans-serif; max-width: 1100px; margin: 0 auto; padding: 12px; }
h1 { font-size: 22px; overflow-wrap: anywhere; }
h2 { font-size: 17px; margin: 26px 0 6px; border-bottom: 1px solid var(--line); }
.plots { display: flex; flex-wrap: wrap; gap: 12px; }
.plots figure { flex: 1 1 420px; margin: 0; min-width: 0; }
.plots svg { width: 100%; height: auto; }
.plots svg > rect:first-child { fill: var(--back); }
.plots text { fill: var(--text); }
.plots line { stroke: var(--line); }
.plots rect[stroke="#444444"] { stroke: var(--dim); }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; margin: 6px 0; }
th, td { padding: 2px 10px 2px 0; border-bottom: 1px solid var(--line); text-align: left; vertical-align: top; overflow-wrap: break-word; }
th { color: var(--dim); font-weight: 600; }
.number { text-align: right; white-space: nowrap; }
.bar { fill: var(--bar); }
.bad { color: var(--bad); }
footer { color: var(--dim); margin-top: 26px; }
)";

/** Carries a trajectory to where another one is. */
Trajectory carriedTo(const Trajectory& there, Trajectory moved)
{
  const std::vector<PosePair> pairs = pairByTime(there, moved);
  if (pairs.empty()) return moved;
  const mrpt::poses::CPose3D T = alignPositions(pairs);
  for (StampedPose& stamped : moved) stamped.pose = T + stamped.pose;
  return moved;
}

ReportTracks tracksOf(
    const std::string& folder, const Json& report, const std::optional<ReportTruth>& truth)
{
  const auto path = [&](const char* name) { return folder + "/" + name; };
  ReportTracks tracks;
  tracks.odometry = readTumTrajectory(path("trajectory_odometry.tum"));
  tracks.corrected = readTumTrajectory(path("trajectory.tum"));
  tracks.objects = readObjectsJson(path("objects.json"));
  tracks.truth = truth;
  // A run in a known map is in the frame of that map, but its odometry is not.
  if (report.contains("map_changes") && !report.at("map_changes").is_null())
    tracks.odometry = carriedTo(tracks.corrected, std::move(tracks.odometry));
  return tracks;
}

/** The text of a key; empty when it is missing or no text. */
std::string textOf(const Json& json, const char* key)
{
  if (!json.is_object() || !json.contains(key) || !json.at(key).is_string()) return "";
  return json.at(key).get<std::string>();
}

std::string headOf(const std::string& title)
{
  return std::string("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n") +
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; base-uri "
         "'none'; form-action 'none'; style-src 'sha256-" +
         base64(sha256(kStyle)) +
         "'\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<title>" +
         htmlText(title) + "</title>\n<style>" + kStyle + "</style>\n</head>\n";
}

std::string plotsOf(const ReportTracks& tracks)
{
  std::string html = "<div class=\"plots\">\n";
  for (const std::string& plot : {trackPlot(tracks), errorPlot(tracks)})
    if (!plot.empty()) html += "<figure>" + plot + "</figure>\n";
  return html + "</div>\n";
}

}  // namespace

std::string reportPage(const std::string& folder, const std::optional<ReportTruth>& truth)
{
  const std::string path = folder + "/report.json";
  const Json report = readJson(path);
  if (!report.is_object() || !report.contains("input"))
    throw std::runtime_error(path + ": is no report of quadmap-slam");
  const ReportTracks tracks = tracksOf(folder, report, truth);
  const std::filesystem::path recording = textOf(report.at("input"), "file");
  const std::string title = "quadmap: " + recording.filename().string();
  return headOf(title) + "<body>\n" + htmlElement("h1", title) + plotsOf(tracks) +
         (truth ? truthSection(*truth) : "") + "<h2>The run</h2>\n" + runSection(report) +
         warningSection(report) + objectSection(tracks.objects) + boxSection(report) +
         timeSection(report) + "<footer>" + htmlText(textOf(report, "program")) + " " +
         htmlText(textOf(report, "program_version")) +
         "; every decision is in report.json.</footer>\n</body>\n</html>\n";
}

}  // namespace quadmap
