#include "quadmap/estimation/LabelPrior.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace quadmap
{
Eigen::Vector3d typicalLogSizes(const Eigen::Vector3d& logSizes, const LabelProperties& label)
{
  Eigen::Vector3d typical = (0.5 * label.typicalSize).array().log();
  if ((logSizes[0] - logSizes[1]) * (typical[0] - typical[1]) < 0)
    std::swap(typical[0], typical[1]);
  return typical;
}

std::array<ResidualRow, kLabelPriorRows> labelPriorRows(
    const Eigen::Vector3d& logSizes, const LabelProperties& label, const EstimatorOptions& options)
{
  const Eigen::Vector3d expected = typicalLogSizes(logSizes, label);
  const double spread = label.sizeSpread * options.sizePriorSpread;

  std::array<ResidualRow, kLabelPriorRows> rows;
  for (std::size_t i = 0; i < 3; ++i)  // (11.17)
  {
    const auto axis = static_cast<Eigen::Index>(i);
    rows[i].r = (logSizes[axis] - expected[axis]) / spread;
    rows[i].d_logSizes[axis] = 1.0 / spread;
  }
  if (label.dominantDirection) return rows;
  rows[3].r = (logSizes[0] - logSizes[1]) / options.roundnessSigma;  // (11.18)
  rows[3].d_logSizes[0] = 1.0 / options.roundnessSigma;
  rows[3].d_logSizes[1] = -1.0 / options.roundnessSigma;
  return rows;
}

void addLabelPrior(
    const UprightState& x,
    const LabelProperties& label,
    const EstimatorOptions& options,
    NormalEquations& equations)
{
  for (const ResidualRow& row : labelPriorRows(x.tail<3>(), label, options))
    equations.add(row.r, row.byUprightState(), RobustKernel::quadratic());
}

double sizeDeviation(const Ellipsoid& object, const LabelProperties& label, ObjectFreedom freedom)
{
  Eigen::Vector3d sizes = 2 * object.semiAxes(), typical = label.typicalSize;
  const int unordered = freedom == ObjectFreedom::Upright ? 2 : 3;
  for (Eigen::Vector3d* all : {&sizes, &typical}) std::sort(all->data(), all->data() + unordered);
  double largest = 0;
  for (Eigen::Index i = 0; i < 3; ++i)
    largest = std::max(largest, std::abs(label.spreadsBetween(sizes[i], typical[i])));
  return largest;
}

}  // namespace quadmap
