#include "Vocabulary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "SampleInventory.h"

using namespace quadmap;
using namespace quadmap::testing;

namespace
{
using Words = std::vector<std::string>;
using Keys = std::set<std::string>;
}  // namespace

TEST(Vocabulary, SplitsTextIntoWords)
{
  EXPECT_EQ(
      wordsOf("What's on the TV-stand_2?"), (Words{"whats", "on", "the", "tv", "stand", "2"}));
  EXPECT_EQ(wordsOf(" \t\n ?! "), Words{});
  EXPECT_EQ(wordsOf("Stühle"), Words{"stühle"}) << "letters beyond ASCII stay";
}

TEST(Vocabulary, KnowsPluralsAndSynonyms)
{
  const Inventory room = livingRoom();
  const Vocabulary words(room);
  const std::map<std::string, std::string> meant = {
      {    "cups",       "cup"},
      {    "mugs",       "cup"},
      {  "knives",     "knife"},
      {   "sofas",     "couch"},
      { "couches",     "couch"},
      {    "mice",     "mouse"},
      { "benches",     "bench"},
      {  "people",    "person"},
      {    "skis",      "skis"},
      { "teddies", "teddybear"},
      {"scissors",  "scissors"},
      {   "books",      "book"}
  };
  for (const auto& [noun, key] : meant) EXPECT_EQ(words.labelsMeantBy({noun}), Keys{key}) << noun;
  EXPECT_EQ(words.labelsMeantBy({"dining", "tables"}), Keys{"diningtable"});
  EXPECT_EQ(words.labelsMeantBy({"flurble"}), Keys{});
  EXPECT_EQ(words.labelsMeantBy({"chair7"}), Keys{}) << "a number is no part of a label";
}

TEST(Vocabulary, TheEndOfALabelMeansAllLabelsThatEndSo)
{
  Inventory room = livingRoom();
  room.items.push_back(standing("12", "Garden_Table", {5, 5}, 0, {1, 1, 1}));
  const Vocabulary words(room);
  EXPECT_EQ(words.labelsMeantBy({"tables"}), (Keys{"diningtable", "coffeetable", "gardentable"}));
  EXPECT_EQ(words.labelsMeantBy({"garden", "table"}), Keys{"gardentable"});
  EXPECT_EQ(words.labelsMeantBy({"able"}), Keys{}) << "whole words";
}

TEST(Vocabulary, OffersWordsThatAreSpeltAlike)
{
  const Inventory room = livingRoom();
  const Vocabulary words(room);
  EXPECT_EQ(words.similarTo("cuup", {}).front(), "cup");
  EXPECT_EQ(words.similarTo("sofaa", {}).front(), "sofa") << "a synonym";
  EXPECT_EQ(words.similarTo("dinning", {}).front(), "dining table") << "one word of a label";
  EXPECT_EQ(words.similarTo("potted", {}).front(), "potted plant") << "half of a label";
  EXPECT_EQ(words.similarTo("nearset", {"nearest"}).front(), "nearest");
  EXPECT_TRUE(words.similarTo("xyzzyx", {"on"}).empty());
  EXPECT_LE(words.similarTo("cap", {}).size(), 3u);
}
