#include "quadmap/base/SimilarWords.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace quadmap
{
std::size_t editDistance(const std::string& a, const std::string& b)
{
  // Rows of the usual table: the last two and the present one.
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    before = std::exchange(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      const bool isSame = a[i - 1] == b[j - 1];
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (isSame ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::size_t> slipsIn(const std::string& word, const std::string& known)
{
  const std::size_t most = std::max<std::size_t>(1, word.size() / 3);
  const std::size_t distance = editDistance(word, known);
  if (distance > most || distance >= word.size()) return std::nullopt;
  return distance;
}

std::optional<std::string> mostSimilar(
    const std::string& word, const std::vector<std::string>& known)
{
  std::optional<std::string> best;
  std::size_t fewest = 0;
  for (const std::string& candidate : known)
    if (const auto slips = slipsIn(word, candidate); slips && (!best || *slips < fewest))
    {
      best = candidate;
      fewest = *slips;
    }
  return best;
}

}  // namespace quadmap
