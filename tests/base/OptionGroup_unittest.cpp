#include "quadmap/base/OptionGroup.h"

#include <sstream>

#include "OptionGroupLaws.h"

namespace quadmap
{
namespace
{
enum class Fruit
{
  Apple,
  Pear
};

constexpr std::pair<Fruit, const char*> kFruits[] = {
    {Fruit::Apple, "apple"},
    { Fruit::Pear,  "pear"},
};

struct Basket : public OptionGroup
{
  double weight = 1.5, most = 9, tilt = fromDegrees(15), place[3] = {0, 0.1, -2};
  unsigned count = 3;
  bool open = true;
  Fruit fruit = Fruit::Apple;
  std::string label = "red";

 private:
  void describe(OptionList& list) override
  {
    list.about("A basket of fruits.");
    list.number("weight", weight, {0, 10}, "kg", "Weight of the fruits.");
    list.number("most", most, {0, 10}, "kg", "Weight that the basket carries.");
    list.angle("tilt_deg", tilt, {0, 90}, "Tilt of the handle.");
    list.vector("place", place, {-5, 5}, "m", "Place of the basket.");
    list.integer("count", count, {0, 10}, "", "Number of the fruits.");
    list.flag("open", open, "True leaves the lid open.");
    list.choice("fruit", fruit, kFruits, "What is in the basket.");
    list.text(
        "label", [this] { return label; }, [this](const std::string& text) { setLabel(text); },
        "a word without a dash", "What is written on the basket.");
    list.leaveKeys("note");
    list.requireLess("weight", "most");
    list.require([this] { return open || count > 0; }, "count: a closed basket is not empty");
  }

  void setLabel(const std::string& text)
  {
    if (text.find('-') != std::string::npos)
      throw std::invalid_argument("label=" + text + ": has a dash");
    label = text;
  }
};

Basket basketFrom(const std::string& lines)
{
  Basket basket;
  basket.loadFromConfigFile(mrpt::config::CConfigFileMemory("[b]\n" + lines), "b");
  return basket;
}

TEST(OptionGroup, ReadsEveryKindOfOption)
{
  const Basket basket = basketFrom(
      "weight = 2.5\ntilt_deg = 90\nplace = 1, 2 3\ncount = 7\nopen = No\nfruit = pear\n"
      "label = green\nnote1 = of another reader\n");
  EXPECT_EQ(basket.weight, 2.5);
  EXPECT_EQ(basket.most, 9) << "a missing key leaves its option alone";
  EXPECT_EQ(basket.tilt, M_PI / 2);
  EXPECT_EQ(basket.place[2], 3);
  EXPECT_EQ(basket.count, 7u);
  EXPECT_FALSE(basket.open);
  EXPECT_EQ(basket.fruit, Fruit::Pear);
  EXPECT_EQ(basket.label, "green");
}

TEST(OptionGroup, NamesSectionKeyValueAndBoundsOfWhatIsWrong)
{
  const struct
  {
    const char *line, *error;
  } cases[] = {
      {          "wieght = 2",                "[b] unknown key \"wieght\"; known: "},
      {         "weight = 11",         "[b] weight=11: must be a number in [0, 10]"},
      {        "weight = nan",        "[b] weight=nan: must be a number in [0, 10]"},
      {            "weight =",           "[b] weight=: must be a number in [0, 10]"},
      {        "weight = 9.5",                 "[b] most=9: must be > weight (9.5)"},
      {       "tilt_deg = 91",       "[b] tilt_deg=91: must be a number in [0, 90]"},
      {         "place = 1 2",              "[b] place=1 2: expected three numbers"},
      {       "place = 1 2 6", "[b] place=1 2 6: \"6\" must be a number in [-5, 5]"},
      {         "count = 2.5",   "[b] count=2.5: must be a whole number in [0, 10]"},
      {        "count = 4abc",  "[b] count=4abc: must be a whole number in [0, 10]"},
      {          "count = 11",    "[b] count=11: must be a whole number in [0, 10]"},
      {          "count = -1",    "[b] count=-1: must be a whole number in [0, 10]"},
      {        "count = 1e30",  "[b] count=1e30: must be a whole number in [0, 10]"},
      {         "count = nan",   "[b] count=nan: must be a whole number in [0, 10]"},
      {         "open = yess",               "[b] open=yess: must be true or false"},
      {        "fruit = plum",         "[b] fruit=plum: must be one of apple, pear"},
      {         "label = a-b",                          "[b] label=a-b: has a dash"},
      {"open = no\ncount = 0",            "[b] count: a closed basket is not empty"},
  };
  for (const auto& c : cases)
    EXPECT_EQ(errorOf([&] { basketFrom(c.line); }).find(c.error), 0u)
        << c.line << " gave " << errorOf([&] { basketFrom(c.line); });
}

TEST(OptionGroup, IsAsItWasWhenReadingFails)
{
  for (const char* wrong : {"fruit = plum", "most = 1", "label = a-b", "weight = 11"})
  {
    Basket basket;
    basket.weight = 1.0 / 3;
    basket.tilt = 1.0 / 7;
    const std::string ini = std::string("[b]\nplace = 1 2 3\nweight = 2.5\ntilt_deg = 3\n") + wrong;
    const mrpt::config::CConfigFileMemory config(
        wrong[0] == 'w' ? "[b]\nplace = 1 2 3\nmost = 8\nweight = 11\n" : ini);
    EXPECT_THROW(basket.loadFromConfigFile(config, "b"), std::invalid_argument) << wrong;
    EXPECT_EQ(basket.weight, 1.0 / 3) << wrong;
    EXPECT_EQ(basket.tilt, 1.0 / 7) << wrong;
    EXPECT_EQ(basket.place[0], 0) << wrong;
    EXPECT_EQ(basket.most, 9) << wrong;
  }
}

TEST(OptionGroup, SavesWithoutLoss)
{
  Basket basket;
  basket.weight = 1.0 / 3;
  basket.tilt = 1.0 / 7;
  basket.place[1] = 0.1 + 0.2;
  basket.count = 5;
  basket.open = false;
  basket.fruit = Fruit::Pear;
  basket.label = "blue";
  const Basket loaded = throughText(basket, "b");
  EXPECT_EQ(loaded.weight, 1.0 / 3);
  EXPECT_EQ(loaded.tilt, 1.0 / 7);
  EXPECT_EQ(loaded.place[1], 0.1 + 0.2);
  EXPECT_EQ(loaded.count, 5u);
  EXPECT_FALSE(loaded.open);
  EXPECT_EQ(loaded.fruit, Fruit::Pear);
  EXPECT_EQ(loaded.label, "blue");
  expectSavesWithoutLoss<Basket>("b");
}

TEST(OptionGroup, WritesShortTexts)
{
  EXPECT_EQ(exactText(0.1), "0.1");
  EXPECT_EQ(exactText(-2), "-2");
  EXPECT_EQ(exactText(100000), "100000");
  EXPECT_EQ(exactText(0.1 + 0.2), "0.30000000000000004");
  Basket basket;
  const OptionList list = basket.options();
  EXPECT_EQ(list.options()[2].text(), "15") << "degrees of a default that was given in degrees";
}

TEST(OptionGroup, DocumentsEveryOption)
{
  const std::string ini = Basket().documentedIni("b");
  EXPECT_EQ(
      ini.substr(0, ini.find("\n\n; Weight that")),
      "[b]\n; A basket of fruits.\n\n; Weight of the fruits. Unit: kg. Range: 0 to 10.\n"
      "weight = 1.5");
  EXPECT_NE(ini.find("; What is in the basket. May be: apple, pear.\nfruit = apple\n"), ini.npos);
  expectDocumented<Basket>("b");
  std::istringstream lines(ini);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
}

TEST(OptionGroup, PrintsEveryOption)
{
  std::ostringstream out;
  Basket().dumpToTextStream(out);
  EXPECT_NE(out.str().find("weight                       = 1.5\n"), std::string::npos);
}

}  // namespace
}  // namespace quadmap
