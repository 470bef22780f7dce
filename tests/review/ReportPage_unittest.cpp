#include "quadmap/review/ReportPage.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "../obs/TemporaryFolder.h"
#include "quadmap/obs/ObjectList.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
const std::string kNasty = "</td><script>attack()</script>&\"'";

/** A straight way along x with odometry that is 0.1 m off at its end, and a cup. */
class ReportPage : public ::testing::Test
{
 protected:
  ReportPage()
  {
    writeTumTrajectory(folder_.path("trajectory.tum"), way(0, 0));
    writeTumTrajectory(folder_.path("trajectory_odometry.tum"), way(0.01, 0));
    ObjectRecord cup;
    cup.id = "7";
    cup.label = kNasty;
    cup.object = Ellipsoid(CPose3D(1, 2, 0.5, 0.3, 0, 0), {0.05, 0.1, 0.2});
    cup.existence = 0.97;
    writeObjectsJson(folder_.path("objects.json"), {cup});
    report_ = nlohmann::json::parse(R"({
      "format": "quadmap-report", "version": 1, "program": "quadmap-slam", "program_version": "1.2.3",
      "input": {"file": "/some/where/kitchen & hall.rawlog", "frames": 321, "keyframes": 45},
      "boxes": {"total": 9, "by_label": {
        "cup": {"complete": 3, "partial": 1, "rejected": 2, "reasons":
          {"complete: cuboid fits the box": 3, "partial: depth in only # % of the box": 1,
           "rejected: too few points": 2}},
        "chair": {"complete": 0, "partial": 0, "rejected": 3, "reasons":
          {"rejected: too few points": 3}}}},
      "map_changes": null, "warnings": ["mind <the> step"],
      "dropped": [{"file": "x.rawlog", "record": 12, "sensor": "camera", "what": "no depth"}],
      "timing": {"threads": 2, "cpu_total_s": 4.2, "peak_memory_mb": 90.5, "modules": {
        "map": {"calls": 45, "cpu_mean_ms": 2.5, "cpu_p95_ms": 3.5, "cpu_total_s": 1.5},
        "perception": {"calls": 45, "cpu_mean_ms": 5, "cpu_p95_ms": 6, "cpu_total_s": 3}}}})");
  }

  /** \param drift Of y from pose to pose [m]. */
  static Trajectory way(double drift, double shift)
  {
    Trajectory trajectory;
    for (int i = 0; i <= 10; ++i)
      trajectory.push_back({100.0 + i, CPose3D(i, shift + drift * i, 0.5, 0, 0, 0)});
    return trajectory;
  }

  std::string page(const std::optional<ReportTruth>& truth = std::nullopt) const
  {
    folder_.write("report.json", report_.dump());
    return reportPage(folder_.folder().string(), truth);
  }

  std::string errorOfPage() const
  {
    try
    {
      reportPage(folder_.folder().string());
    }
    catch (const std::runtime_error& e)
    {
      return e.what();
    }
    return "none";
  }

  TemporaryFolder folder_;
  nlohmann::json report_;
};

bool has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/** The first tag that does not fit those that are open; empty when all are closed in order. */
std::string firstWrongTag(const std::string& html)
{
  std::vector<std::string> open;
  const std::regex tag("<(/?)([a-z0-9]+)[^>]*?(/?)>");
  for (auto it = std::sregex_iterator(html.begin(), html.end(), tag); it != std::sregex_iterator();
       ++it)
  {
    const std::string name = (*it)[2];
    if ((*it)[3].length() > 0 || name == "meta") continue;
    if ((*it)[1].length() == 0)
      open.push_back(name);
    else if (open.empty() || open.back() != name)
      return it->str();
    else
      open.pop_back();
  }
  return open.empty() ? "" : open.back();
}

/** How often a tag is opened. */
int countOf(const std::string& html, const std::string& part)
{
  int count = 0;
  for (auto at = html.find(part); at != std::string::npos; at = html.find(part, at + 1)) ++count;
  return count;
}
}  // namespace

TEST_F(ReportPage, TellsWhatHappened)
{
  const std::string html = page();
  for (const char* part :
       {"<h1>quadmap: kitchen &amp; hall.rawlog</h1>", "<td>frames</td><td>321</td>",
        "<li>mind &lt;the&gt; step</li>", "<td>x.rawlog</td><td class=\"number\">12</td>",
        "<td>rejected: too few points</td><td class=\"number\">5</td><td>chair 3, cup 2</td>",
        "<td>partial: depth in only # % of the box</td><td class=\"number\">1</td>",
        "<td>perception</td><td class=\"number\">45</td>", "4.2 s of CPU time", "before (odometry)",
        "0.10 × 0.20 × 0.40", "quadmap-slam 1.2.3"})
    EXPECT_TRUE(has(html, part)) << part;
  EXPECT_LT(html.find("rejected: too few"), html.find("partial: depth in")) << "worst first";
  EXPECT_FALSE(has(html, "cuboid fits the box")) << "nothing is wrong with these";
  EXPECT_EQ(countOf(html, "<svg"), 2 + 2) << "two diagrams, two bars";
  EXPECT_EQ(firstWrongTag(html), "");
  EXPECT_EQ(page(), html) << "the same bytes";
}

TEST_F(ReportPage, StandsAloneAndRunsNothing)
{
  report_["warnings"] = {kNasty};
  report_["input"]["file"] = kNasty;
  report_["boxes"]["by_label"][kNasty] = {
      {"complete",                           1},
      { "reasons", {{"partial: " + kNasty, 1}}}
  };
  report_["timing"]["modules"][kNasty] = {
      {"calls", kNasty}
  };
  const std::string html = page();
  EXPECT_FALSE(has(html, "<script"));
  EXPECT_TRUE(has(html, "&lt;script&gt;attack()&lt;/script&gt;&amp;")) << "it is there, as text";
  EXPECT_TRUE(has(html, "default-src 'none'"));
  for (const char* part : {"src=", "href=", "url(", "@import", "onload"})
    EXPECT_FALSE(has(html, part)) << part;
  EXPECT_EQ(firstWrongTag(html), "");
  EXPECT_TRUE(has(html, "prefers-color-scheme: dark"));
}

TEST_F(ReportPage, ShowsErrorsAgainstATruth)
{
  ReportTruth truth;
  truth.figures.trajectory = TrajectoryEvaluation{11, 11, 0.0123, 0.0456};
  truth.figures.T_truth_estimated = CPose3D(0, 5, 0, 0, 0, 0);
  truth.figures.notes = {"a note"};
  truth.trajectory = way(0, 5);
  const std::string html = page(truth);
  EXPECT_TRUE(
      has(html,
          "<td>ATE RMSE [m]</td><td class=\"number\">0.0456</td><td class=\"number\">0.0123</td>"));
  EXPECT_TRUE(has(html, "a note"));
  EXPECT_TRUE(has(html, "Error of the positions"));
  EXPECT_FALSE(has(html, "true objects")) << "none were given";
  EXPECT_EQ(firstWrongTag(html), "");
  EXPECT_FALSE(has(page(), "Against the truth"));
  // The truth lies on the corrected way in the map, so that both lines have the same points.
  const auto line = [&](const std::string& color)
  {
    std::smatch match;
    const std::regex polyline("<polyline points=\"([^\"]*)\" stroke=\"" + color);
    return std::regex_search(html, match, polyline) ? match[1].str() : "";
  };
  EXPECT_EQ(line("#2ca02c"), line("#2b7de0"));
  EXPECT_NE(line("#8a8a8a"), line("#2b7de0"));
}

TEST_F(ReportPage, ErrorsAreThoseOfTheComparison)
{
  // The truth lies 5 m beside the corrected way, and its clock is 0.3 s late.
  ReportTruth truth;
  truth.trajectory = way(0, 5);
  for (StampedPose& stamped : *truth.trajectory) stamped.time += 0.3;
  const auto errorPlot = [&]
  {
    const std::string html = page(truth);
    const auto begin = html.rfind("<svg", html.find("Error of the positions"));
    return html.substr(begin, html.find("</svg>", begin) - begin);
  };
  const std::regex line("<polyline points=\"[0-9]");
  EXPECT_FALSE(std::regex_search(errorPlot(), line)) << "no poses are of the same time";
  truth.maxTimeDifference = 0.5;
  EXPECT_TRUE(std::regex_search(errorPlot(), line));
  const auto largestError = [&]
  {
    const std::string svg = errorPlot();
    const std::regex tick("text-anchor=\"end\"[^>]*>([0-9.]+)</text>");
    double largest = 0;
    for (auto it = std::sregex_iterator(svg.begin(), svg.end(), tick); it != std::sregex_iterator();
         ++it)
      largest = std::max(largest, std::stod((*it)[1]));
    return largest;
  };
  EXPECT_LT(largestError(), 1);
  truth.inPlace = true;
  EXPECT_GE(largestError(), 4) << "[m], a tick of the axis";
}

TEST_F(ReportPage, DrawsOdometryWhereTheKnownMapIs)
{
  // The odometry has its own frame when a run started in a known map.
  Trajectory elsewhere = way(0.01, 0);
  for (StampedPose& stamped : elsewhere) stamped.pose = CPose3D(50, 50, 0, 1, 0, 0) + stamped.pose;
  writeTumTrajectory(folder_.path("trajectory_odometry.tum"), elsewhere);
  const std::regex tick(">([0-9]+)</text>");
  const auto largestTick = [&](const std::string& html)
  {
    int largest = 0;
    for (auto it = std::sregex_iterator(html.begin(), html.end(), tick);
         it != std::sregex_iterator(); ++it)
      largest = std::max(largest, std::stoi((*it)[1]));
    return largest;
  };
  EXPECT_GE(largestTick(page()), 50);
  report_["map_changes"] = {
      {"found", {1}}
  };
  EXPECT_LE(largestTick(page()), 20);
}

TEST_F(ReportPage, LeavesOutWhatTheReportLacks)
{
  report_ = nlohmann::json::parse(
      R"({"input": 5, "boxes": [], "timing": {"modules": 1}, "warnings": 3, "program": 4})");
  EXPECT_TRUE(has(errorOfPage(), folder_.path("report.json") + ": cannot be read"));
  const std::string html = page();
  EXPECT_TRUE(has(html, "<td>frames</td><td>-</td>"));
  EXPECT_EQ(firstWrongTag(html), "");
  folder_.write("report.json", "[1]");
  EXPECT_EQ(errorOfPage(), folder_.path("report.json") + ": is no report of quadmap-slam");
  folder_.write("report.json", report_.dump());
  std::filesystem::remove(folder_.path("trajectory.tum"));
  EXPECT_TRUE(has(errorOfPage(), "trajectory.tum")) << errorOfPage();
}
