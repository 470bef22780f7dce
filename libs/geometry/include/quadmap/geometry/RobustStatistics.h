#pragma once

#include <vector>

namespace quadmap
{
/** p-quantile (0 <= p <= 1, linear interpolation) of the finite values.
 * \exception std::invalid_argument If there is no finite value or p is out of range. */
double quantile(std::vector<double> values, double p);

/** The p- and the (1 - p)-quantile, p < 0.5. */
struct QuantileRange
{
  double low, high;
  double width() const { return high - low; }
};
QuantileRange quantileRange(std::vector<double> values, double p);

double median(std::vector<double> values);

/** Standard deviation estimated from the median absolute deviation (times 1.4826). */
double madSigma(const std::vector<double>& values);

/** Huber's weight for a normalised residual: 1 inside the threshold, threshold/|r| outside. */
double huberWeight(double normalisedResidual, double threshold);

}  // namespace quadmap
