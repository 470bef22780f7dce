#include "EdgeTable.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "FrameMeasurer.h"

namespace quadmap::observations
{
namespace
{
/** Edges under one rule. */
struct EdgeCounts
{
  std::size_t good = 0, invalid = 0, usableGood = 0, usableInvalid = 0;

  void add(bool isInvalid, bool isUsable)
  {
    ++(isInvalid ? invalid : good);
    if (isUsable) ++(isInvalid ? usableInvalid : usableGood);
  }
};

struct Rule
{
  const char* name;
  double borderMargin, maxHiddenProbability;  // 0 and 1: off
};

std::vector<Rule> rules()
{
  const PerceptionOptions standard;
  return {
      {     "none",                     0,                             1},
      {   "border", standard.borderMargin,                             1},
      {"occlusion",                     0, standard.maxHiddenProbability},
      {     "both", standard.borderMargin, standard.maxHiddenProbability}
  };
}

class EdgeTable
{
 public:
  explicit EdgeTable(const EdgeTruthOptions& truth) : truth_(truth) {}

  void add(const std::string& rule, const ObservedFrame& frame, const CObservationObjects& measured)
  {
    for (std::size_t b = 0; b < measured.objects.size(); ++b)
    {
      if (!frame.truth[b]) continue;
      const DetectedObject& object = measured.objects[b];
      const auto& seen = frame.truth[b]->visible;
      const auto beyond = pixelsBeyond(object.box, seen.outline);
      const auto hidden = pixelsBeyond(seen.box, seen.outline);
      for (std::size_t e = 0; e < 4; ++e)
      {
        const auto& edges = object.measurement.edges;
        const double across = e % 2 == 0 ? object.box.width() : object.box.height();
        const auto sigma = PerceptionOptions().edgeSigmaIn(measured.cameraParams.ncols, across);
        const bool isUsable = edges && (*edges)[e].state == EdgeState::Usable;
        const bool isInvalid =
            beyond[e] > PerceptionOptions::scaledPixels(truth_.beyond, measured.cameraParams.ncols);
        for (const std::string& row : {std::string("all"), kEdges[e], frame.truth[b]->label})
          counts_[row][rule].add(isInvalid, isUsable);
        for (std::size_t k = 0; k < kSigmas.size(); ++k)
          bySigmas_[rule][k].add(beyond[e] > kSigmas[k] * sigma, isUsable);
        const double size = e % 2 == 0 ? seen.box.width() : seen.box.height();
        byVisible_[rule].add(
            hidden[e] > 3.0 * measured.cameraParams.ncols / 640 + 0.03 * size, isUsable);
      }
    }
  }

  /** Of all edges and of each side. */
  Rows rows() const
  {
    Rows out;
    std::vector<std::string> names{"all"};
    names.insert(names.end(), kEdges.begin(), kEdges.end());
    for (const auto& name : names)
      for (const auto& rule : rules())
      {
        const auto found = counts_.find(name);
        if (found == counts_.end() || (name != "all" && rule.name != std::string("both"))) continue;
        const EdgeCounts& n = found->second.at(rule.name);
        out.push_back({
            name + " / " + rule.name,
            {{"good", static_cast<double>(n.good)},
                                  {"invalid", static_cast<double>(n.invalid)},
                                  {"usable_good", static_cast<double>(n.usableGood)},
                                  {"usable_invalid", static_cast<double>(n.usableInvalid)}}
        });
      }
    return out;
  }

  void print(bool perLabel, std::ostream& out) const
  {
    out << mrpt::format(
        "%-20s %-10s %6s %7s %8s %16s %12s\n", "edges", "rule", "good", "invalid", "usable",
        "invalid of them", "good kept");
    printRow("all", out);
    for (const auto& edge : kEdges) printRow(edge, out);
    for (const auto& [row, byRule] : counts_)
      if (perLabel && row != "all" && std::find(kEdges.begin(), kEdges.end(), row) == kEdges.end())
        printRow(row, out);
    out << "\nall edges, invalid when the outline ends beyond them by more than\n";
    for (std::size_t k = 0; k < kSigmas.size(); ++k)
      for (const auto& rule : rules())
        printCounts(
            mrpt::format("%.0f sigma", kSigmas[k]), rule.name, bySigmas_.at(rule.name)[k], out);
    out << "all edges, invalid when it ends beyond the visible part by more than\n";
    for (const auto& rule : rules())
      printCounts("3 px of 640 + 3 %", rule.name, byVisible_.at(rule.name), out);
  }

 private:
  void printRow(const std::string& row, std::ostream& out) const
  {
    const auto found = counts_.find(row);
    if (found == counts_.end()) return;
    for (const auto& rule : rules()) printCounts(row, rule.name, found->second.at(rule.name), out);
  }

  static void printCounts(
      const std::string& row, const std::string& rule, const EdgeCounts& n, std::ostream& out)
  {
    const auto usable = static_cast<double>(n.usableGood + n.usableInvalid);
    out << mrpt::format(
        "%-20s %-10s %6zu %7zu %8.0f %14.2f %% %10.1f %%\n", row.c_str(), rule.c_str(), n.good,
        n.invalid, usable, 100.0 * static_cast<double>(n.usableInvalid) / std::max(1.0, usable),
        100.0 * static_cast<double>(n.usableGood) / std::max(1.0, static_cast<double>(n.good)));
  }

  inline static const std::array<std::string, 4> kEdges{"left", "top", "right", "bottom"};
  static constexpr std::array<double, 3> kSigmas{1, 2, 3};  // definitions to compare

  EdgeTruthOptions truth_;
  std::map<std::string, std::map<std::string, EdgeCounts>> counts_;         // row, rule
  std::map<std::string, std::array<EdgeCounts, kSigmas.size()>> bySigmas_;  // rule
  std::map<std::string, EdgeCounts> byVisible_;  // rule; sterner: what is hidden at all
};

}  // namespace

std::array<double, 4> pixelsBeyond(const ImageBox& box, const ImageBox& outline)
{
  return {box.x1 - outline.x1, box.y1 - outline.y1, outline.x2 - box.x2, outline.y2 - box.y2};
}

Rows printEdgeTable(
    const RunOptions& run, const EdgeTruthOptions& truth, bool perLabel, std::ostream& out)
{
  const auto labels = LabelTable::installed();
  EdgeTable table(truth);
  std::map<std::string, FrameMeasurer> measurers;
  const auto startRules = [&]
  {
    measurers.clear();
    for (const auto& rule : rules())
    {
      PerceptionOptions options;
      options.borderMargin = rule.borderMargin;
      options.maxHiddenProbability = rule.maxHiddenProbability;
      measurers.try_emplace(rule.name, options, labels);
    }
  };
  std::optional<std::uint64_t> seed;
  runScene(
      run, PerceptionOptions(), labels,
      [&](const ObservedFrame& frame)
      {
        if (seed != frame.seed) startRules();
        seed = frame.seed;
        for (auto& [rule, measurer] : measurers) table.add(rule, frame, measurer.measure(frame));
      });
  table.print(perLabel, out);
  return table.rows();
}

}  // namespace quadmap::observations
