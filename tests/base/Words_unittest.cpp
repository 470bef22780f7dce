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
