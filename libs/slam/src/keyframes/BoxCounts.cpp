#include "keyframes/BoxCounts.h"

#include <mrpt/core/format.h>

#include <cctype>

namespace quadmap
{
namespace
{
/** The reason without its numbers, so that similar reasons are counted together. */
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

}  // namespace

void countBoxes(
    const CObservationObjects& boxes,
    const LabelTable& labels,
    std::map<std::string, LabelCounts>& counts)
{
  for (const auto& object : boxes.objects)
  {
    LabelCounts& n = counts[labels.canonical(object.label)];
    std::string kind = "rejected";
    switch (object.measurement.kind)
    {
      case MeasurementKind::Complete:
        ++n.complete;
        kind = "complete";
        break;
      case MeasurementKind::Partial:
        ++n.partial;
        kind = "partial";
        break;
      default:
        ++n.rejected;
    }
    ++n.reasons[kind + ": " + kindOfReason(object.measurement.reason)];
  }
}

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

}  // namespace quadmap
