#include "EdgeWeights.h"

#include <mrpt/core/format.h>

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "FrameMeasurer.h"
#include "LogisticRegression.h"

namespace quadmap::observations
{
namespace
{
/** Edges of one side of objects, with their truth. */
struct Examples
{
  std::vector<std::vector<HiddenTerm>> terms;
  std::vector<double> isHidden;  // 0 or 1

  Eigen::MatrixXd evidence() const
  {
    if (terms.empty()) throw std::runtime_error("no box edges to fit weights to");
    const auto columns = static_cast<Eigen::Index>(terms.front().size());
    Eigen::MatrixXd out(static_cast<Eigen::Index>(terms.size()), columns);
    for (Eigen::Index i = 0; i < out.rows(); ++i)
      for (Eigen::Index j = 0; j < columns; ++j)
        out(i, j) = terms[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].evidence;
    return out;
  }
  Eigen::VectorXd truth() const
  {
    return Eigen::Map<const Eigen::VectorXd>(
        isHidden.data(), static_cast<Eigen::Index>(isHidden.size()));
  }
};

class WeightTable
{
 public:
  explicit WeightTable(const EdgeTruthOptions& truth) : truth_(truth) {}

  void add(const ObservedFrame& frame, const std::vector<std::optional<BoxEvidence>>& boxes)
  {
    const double beyond =
        PerceptionOptions::scaledPixels(truth_.beyond, frame.boxes.cameraParams.ncols);
    for (std::size_t b = 0; b < boxes.size(); ++b)
    {
      if (!boxes[b] || !frame.truth[b]) continue;
      const auto& seen = frame.truth[b]->visible;
      const auto hidden = pixelsBeyond(seen.box, seen.outline);
      for (std::size_t e = 0; e < hidden.size(); ++e)
      {
        const EdgeEvidence& edge = (*boxes[b])[e];
        if (edge.isRefused) continue;
        Examples& side = sides_[static_cast<std::size_t>(edge.side)];
        side.terms.push_back(hiddenTerms(edge.side, edge.hidden));
        side.isHidden.push_back(hidden[e] > beyond ? 1 : 0);
      }
    }
  }

  Rows print(std::ostream& out) const
  {
    Rows rows;
    out << mrpt::format("%-8s %-20s %8s %8s %8s\n", "edges", "evidence", "weight", "+-", "in use");
    for (std::size_t s = 0; s < sides_.size(); ++s)
    {
      const Examples& side = sides_[s];
      const LogisticFit fit = fitLogistic(side.evidence(), side.truth());
      for (std::size_t j = 0; j < side.terms.front().size(); ++j)
      {
        const HiddenTerm& term = side.terms.front()[j];
        const auto row = static_cast<Eigen::Index>(j);
        out << mrpt::format(
            "%-8s %-20s %8.2f %8.2f %8.2f\n", kNames[s], term.name, fit.weights[row],
            fit.sigmas[row], term.weight);
        rows.push_back({
            std::string(kNames[s]) + " / " + term.name,
            {{"weight", fit.weights[row]}, {"sigma", fit.sigmas[row]}, {"in_use", term.weight}}
        });
      }
      out << mrpt::format(
          "%-8s %zu edges, %.0f of them hidden\n", kNames[s], side.isHidden.size(),
          side.truth().sum());
    }
    return rows;
  }

 private:
  static constexpr std::array<const char*, 3> kNames{"top", "bottom", "sides"};  // ObjectSide

  EdgeTruthOptions truth_;
  std::array<Examples, 3> sides_;  // by ObjectSide
};

}  // namespace

Rows printEdgeWeights(const RunOptions& run, const EdgeTruthOptions& truth, std::ostream& out)
{
  const auto labels = LabelTable::installed();
  WeightTable table(truth);
  std::optional<FrameMeasurer> measurer;
  std::optional<std::uint64_t> seed;
  runScene(
      run, PerceptionOptions(), labels,
      [&](const ObservedFrame& frame)
      {
        if (seed != frame.seed) measurer.emplace(PerceptionOptions(), labels);
        seed = frame.seed;
        table.add(frame, measurer->edgeEvidence(frame));
        measurer->measure(frame);
      });
  return table.print(out);
}

}  // namespace quadmap::observations
