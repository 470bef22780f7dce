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

TEST(QuotedWord, ShowsTheBeginningOfALongWord)
{
  EXPECT_EQ(quotedWord("1.5x"), "'1.5x'");
  EXPECT_EQ(quotedWord(std::string(60, 'a')), "'" + std::string(60, 'a') + "'");
  EXPECT_EQ(quotedWord(std::string(1'000'000, 'a')), "'" + std::string(60, 'a') + "...'");
  EXPECT_EQ(
      quotedWord(std::string(59, 'a') + "\xC3\xA4" + "b"), "'" + std::string(59, 'a') + "...'")
      << "letters stay whole";
  EXPECT_EQ(quotedWord("\x1b[2J"), "'?[2J'");
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
