#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstddef>

#include "quadmap/estimation/EstimatorOptions.h"
#include "quadmap/estimation/NormalEquations.h"
#include "quadmap/estimation/ResidualRow.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** Number of rows that labelPriorRows() gives. */
constexpr std::size_t kLabelPriorRows = 4;

/** Logarithms of the label's typical half sizes. Those along x and y are named in the order that
 * fits. \param logSizes (ln a, ln b, ln c) of the object. */
Eigen::Vector3d typicalLogSizes(const Eigen::Vector3d& logSizes, const LabelProperties& label);

/** What the label alone says of an object's sizes, in standard deviations: three rows of the
 * typical size (doc/mathematics.md, (11.17)) and one row of the roundness (11.18), which is zero
 * when the label has a dominant direction. They come under no robust kernel.
 * \param logSizes (ln a, ln b, ln c). */
std::array<ResidualRow, kLabelPriorRows> labelPriorRows(
    const Eigen::Vector3d& logSizes, const LabelProperties& label, const EstimatorOptions& options);

/** Adds these rows to the normal equations of an upright object. */
void addLabelPrior(
    const UprightState& x,
    const LabelProperties& label,
    const EstimatorOptions& options,
    NormalEquations& equations);

/** Largest deviation of a size from the label's typical one, in spreads: doc/mathematics.md, (9.5)
 * without its sign. Which horizontal axis of an upright object is x is arbitrary, and so are all
 * names of a free one's: sizes are compared in the order of length. */
double sizeDeviation(const Ellipsoid& object, const LabelProperties& label, ObjectFreedom freedom);

}  // namespace quadmap
