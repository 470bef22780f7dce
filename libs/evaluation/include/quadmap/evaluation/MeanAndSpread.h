#pragma once

#include <optional>
#include <string>
#include <vector>

namespace quadmap
{
/** One number over several runs; a run for which it does not exist does not count. */
class MeanAndSpread
{
 public:
  void add(const std::optional<double>& value)
  {
    if (value) values_.push_back(*value);
  }
  std::size_t count() const { return values_.size(); }
  std::optional<double> mean() const;
  /** Standard deviation of a sample (n - 1); nothing with fewer than two values. */
  std::optional<double> deviation() const;

  /** "0.015 +- 0.002", "0.015" of a single value, "-" of none. */
  std::string text(int decimals) const;

 private:
  std::vector<double> values_;
};

}  // namespace quadmap
