#include "quadmap/base/SimilarWords.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace quadmap;

namespace
{
using Words = std::vector<std::string>;

/** The edit distance by its definition, with exchanges. */
std::size_t slowDistance(const std::string& a, const std::string& b)
{
  if (a.empty() || b.empty()) return a.size() + b.size();
  const auto from = [](const std::string& s, std::size_t n) { return s.substr(n); };
  if (a[0] == b[0]) return slowDistance(from(a, 1), from(b, 1));
  std::size_t least = std::min(
      {slowDistance(from(a, 1), b), slowDistance(a, from(b, 1)),
       slowDistance(from(a, 1), from(b, 1))});
  if (a.size() > 1 && b.size() > 1 && a[0] == b[1] && a[1] == b[0])
    least = std::min(least, slowDistance(from(a, 2), from(b, 2)));
  return 1 + least;
}
}  // namespace

TEST(SimilarWords, EditDistanceAgreesWithItsDefinition)
{
  EXPECT_EQ(editDistance("chiar", "chair"), 1u) << "neighbours exchanged";
  EXPECT_EQ(editDistance("", "cup"), 3u);
  const Words words = {"",      "a",     "cup",  "cpu", "cups", "pucs",
                       "chair", "chiar", "hair", "tea", "eat"};
  for (const std::string& a : words)
    for (const std::string& b : words) EXPECT_EQ(editDistance(a, b), slowDistance(a, b)) << a << b;
}

TEST(SimilarWords, AThirdOfTheLettersMayBeWrong)
{
  EXPECT_EQ(slipsIn("nearset", "nearest"), 1u);
  EXPECT_EQ(slipsIn("nearset", "near"), std::nullopt);
  EXPECT_EQ(slipsIn("on", "in"), 1u) << "one in any case";
  EXPECT_EQ(slipsIn("a", "b"), std::nullopt) << "nothing would be left of it";
}

TEST(SimilarWords, TheMostSimilarWordIsMeant)
{
  EXPECT_EQ(mostSimilar("lables", {"tables", "label", "labels"}), "tables") << "the first of equal";
  EXPECT_EQ(mostSimilar("camrea", {"camcorder", "camera-serial", "camera"}), "camera");
  EXPECT_EQ(mostSimilar("xyzzy", {"camera"}), std::nullopt);
  EXPECT_EQ(mostSimilar("camera", {}), std::nullopt);
}
