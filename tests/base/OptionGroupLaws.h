#pragma once

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "../obs/TemporaryFolder.h"
#include "quadmap/base/OptionGroup.h"
#include "quadmap/base/OptionList.h"

// What holds for every group of options, whatever its keys are.
namespace quadmap
{
/** The group as the text of an INI file, and back. */
template <typename Group>
Group throughText(const Group& group, const std::string& section)
{
  mrpt::config::CConfigFileMemory saved;
  group.saveToConfigFile(saved, section);
  Group loaded;
  loaded.loadFromConfigFile(mrpt::config::CConfigFileMemory(saved.getContent()), section);
  return loaded;
}

/** A value within the bounds, in the unit of the field, with all digits of a double. */
inline double randomValue(const Option& option, std::mt19937& random)
{
  const double share = std::uniform_real_distribution<double>(0.05, 0.95)(random);
  const Bounds& b = option.bounds;
  const double value =
      b.min > 0 ? b.min * std::pow(b.max / b.min, share) : b.min + share * (b.max - b.min);
  return option.isAngle ? value * M_PI / 180 : value;
}

inline void expectSameOptions(const OptionList& a, const OptionList& b, const std::string& section)
{
  for (std::size_t i = 0; i < a.options().size(); ++i)
  {
    const auto &x = a.options()[i], &y = b.options()[i];
    EXPECT_EQ(x.text(), y.text()) << section << " " << x.key;
    if (!x.number) continue;
    EXPECT_EQ(*x.number, *y.number) << section << " " << x.key;
  }
}

/** Gives one real number after the other a random value. */
template <typename Group>
void expectSavesWithoutLoss(const std::string& section)
{
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round)
  {
    Group group;
    const OptionList list = group.options();
    const auto& option = list.options()[static_cast<std::size_t>(round) % list.options().size()];
    if (!option.number) continue;
    *option.number = randomValue(option, random);
    Group loaded;
    try
    {
      loaded = throughText(group, section);
    }
    catch (const std::invalid_argument& e)
    {
      ASSERT_NE(std::string(e.what()).find("must be >"), std::string::npos) << e.what();
      continue;  // the value contradicts another option
    }
    expectSameOptions(list, loaded.options(), section);
  }
}

template <typename Group>
std::string loadingError(const std::string& section, const std::string& line)
{
  return errorOf(
      [&]
      {
        Group group;
        group.loadFromConfigFile(
            mrpt::config::CConfigFileMemory("[" + section + "]\n" + line + "\n"), section);
      });
}

template <typename Group>
void expectRefusesWhatIsWrong(const std::string& section)
{
  Group group;
  const OptionList list = group.options();
  EXPECT_EQ(
      loadingError<Group>(section, "noSuchKey = 1").find("[" + section + "] unknown key \"noSuch"),
      0u);
  for (const auto& option : list.options())
  {
    const bool isNumber = option.bounds.min < option.bounds.max;
    std::vector<std::string> wrong{"4abc"};
    if (isNumber)
      for (const double value :
           {option.bounds.min - 1 - std::abs(option.bounds.min),
            option.bounds.max + 1 + std::abs(option.bounds.max),
            std::numeric_limits<double>::quiet_NaN()})
        wrong.push_back(exactText(value));
    for (const auto& text : wrong)
    {
      const std::string error = loadingError<Group>(section, option.key + " = " + text);
      const std::string place = "[" + section + "] " + option.key + "=" + text + ": ";
      EXPECT_EQ(error.find(place), 0u) << place << " gave " << error;
    }
  }
}

/** Every option says in whole sentences what it does. */
template <typename Group>
void expectDocumented(const std::string& section)
{
  Group group;
  const OptionList list = group.options();
  EXPECT_FALSE(list.about().empty()) << section;
  for (const auto& option : list.options())
  {
    EXPECT_GT(option.reason.size(), 10u) << section << " " << option.key;
    EXPECT_EQ(option.reason.back(), '.') << section << " " << option.key;
    EXPECT_FALSE(option.range.empty()) << section << " " << option.key;
  }
  Group loaded;
  loaded.loadFromConfigFile(mrpt::config::CConfigFileMemory(group.documentedIni(section)), section);
  expectSameOptions(list, loaded.options(), section);
}

template <typename Group>
void expectLaws(const std::string& section)
{
  expectSavesWithoutLoss<Group>(section);
  expectRefusesWhatIsWrong<Group>(section);
  expectDocumented<Group>(section);
}

}  // namespace quadmap
