#pragma once

#include <vector>

namespace quadmap
{
/** p-quantile (0 <= p <= 1, linear interpolation) of the finite values.
 * \exception std::invalid_argument If there is no finite value or p is out of range. */
double quantile(std::vector<double> values, double p);

/** The p-quantile and the (1 - p)-quantile, p < 0.5. */
struct QuantileRange
{
  double low, high;
  double width() const { return high - low; }
};
QuantileRange quantileRange(std::vector<double> values, double p);

double median(std::vector<double> values);

/** Standard deviation estimated as 1.4826 times the median absolute deviation. */
double madSigma(const std::vector<double>& values);

}  // namespace quadmap
