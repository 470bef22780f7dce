#pragma once

#include <optional>
#include <string>
#include <vector>

namespace quadmap
{
/** Mean and standard deviation of a number over several runs. Runs without it do not count. */
class MeanAndSpread
{
 public:
  void add(const std::optional<double>& value)
  {
    if (value) values_.push_back(*value);
  }
  std::size_t count() const { return values_.size(); }
  std::optional<double> mean() const;
  /** Standard deviation of a sample (n - 1), or nothing for fewer than two values. */
  std::optional<double> deviation() const;

  /** "0.015 +- 0.002", or "0.015" for a single value, or "-" for none. */
  std::string text(int decimals) const;

 private:
  std::vector<double> values_;
};

}  // namespace quadmap
