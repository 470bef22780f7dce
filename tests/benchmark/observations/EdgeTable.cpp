#include "EdgeTable.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <array>
#include <map>

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

/** How much further out than the visible box the whole outline ends at each edge [px]. */
std::array<double, 4> hiddenPixels(const simulator::VisibleObject& seen)
{
  return {
      seen.box.x1 - seen.outline.x1, seen.box.y1 - seen.outline.y1, seen.outline.x2 - seen.box.x2,
      seen.outline.y2 - seen.box.y2};
}

class EdgeTable
{
 public:
  explicit EdgeTable(const EdgeTruthOptions& truth) : truth_(truth) {}

  void add(const std::string& rule, const ObservedFrame& frame, const CObservationObjects& measured)
  {
    static const char* const kEdges[] = {"left", "top", "right", "bottom"};
    for (std::size_t b = 0; b < measured.objects.size(); ++b)
    {
      if (!frame.truth[b]) continue;
      const auto& seen = frame.truth[b]->visible;
      const auto hidden = hiddenPixels(seen);
      const auto& edges = measured.objects[b].measurement.edges;
      for (std::size_t e = 0; e < 4; ++e)
      {
        const double size = e % 2 == 0 ? seen.box.width() : seen.box.height();
        const double scale = measured.cameraParams.ncols / 640.0;
        const bool isInvalid = hidden[e] > truth_.pixels * scale + truth_.share * size;
        const bool isUsable = edges && (*edges)[e].state == EdgeState::Usable;
        for (const std::string& row :
             {std::string("all"), std::string(kEdges[e]), frame.truth[b]->label})
          counts_[row][rule].add(isInvalid, isUsable);
      }
    }
  }

  void print(std::ostream& out) const
  {
    out << mrpt::format(
        "%-16s %-10s %6s %6s %8s %16s %12s\n", "edges", "rule", "good", "invalid", "usable",
        "invalid of them", "good kept");
    printRow("all", out);
    for (const char* edge : {"left", "top", "right", "bottom"}) printRow(edge, out);
    for (const auto& [row, byRule] : counts_)
      if (row != "all" && row != "left" && row != "top" && row != "right" && row != "bottom")
        printRow(row, out);
  }

 private:
  void printRow(const std::string& row, std::ostream& out) const
  {
    const auto found = counts_.find(row);
    if (found == counts_.end()) return;
    for (const auto& rule : rules())
    {
      const EdgeCounts& n = found->second.at(rule.name);
      const auto usable = static_cast<double>(n.usableGood + n.usableInvalid);
      out << mrpt::format(
          "%-16s %-10s %6zu %6zu %8.0f %14.2f %% %10.1f %%\n", row.c_str(), rule.name, n.good,
          n.invalid, usable, 100.0 * static_cast<double>(n.usableInvalid) / std::max(1.0, usable),
          100.0 * static_cast<double>(n.usableGood) / std::max(1.0, static_cast<double>(n.good)));
    }
  }

  EdgeTruthOptions truth_;
  std::map<std::string, std::map<std::string, EdgeCounts>> counts_;  // row, rule
};

}  // namespace

void printEdgeTable(const RunOptions& run, const EdgeTruthOptions& truth, std::ostream& out)
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
  table.print(out);
}

}  // namespace quadmap::observations
