#include "quadmap/base/Words.h"

#include <gtest/gtest.h>

using namespace quadmap;

TEST(WordsOf, StandBetweenBlanks)
{
  using Words = std::vector<std::string>;
  EXPECT_EQ(wordsOf("1 -2e3\t x\r"), (Words{"1", "-2e3", "x"}));
  EXPECT_EQ(wordsOf("  1,2 \v\f\n"), Words{"1,2"});
  EXPECT_EQ(wordsOf("a"), Words{"a"});
  for (const char* nothing : {"", " ", "\t \r"}) EXPECT_TRUE(wordsOf(nothing).empty());
}

TEST(FirstFew, TellHowManyMoreThereAre)
{
  std::set<std::string> names{"e", "b", "a"};
  EXPECT_EQ(firstFew(names), "a, b, e");
  for (const char* name : {"c", "d"}) names.insert(name);
  EXPECT_EQ(firstFew(names), "a, b, c, d, e");
  for (int i = 0; i < 295; ++i) names.insert("x" + std::to_string(i));
  EXPECT_EQ(firstFew(names), "a, b, c, d, e and 295 more");
  EXPECT_EQ(firstFew({std::string(200, 'a')}), std::string(60, 'a') + "...");
}
