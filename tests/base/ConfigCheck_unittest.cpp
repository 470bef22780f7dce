#include "quadmap/base/ConfigCheck.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

#include <cmath>

#include "../obs/TemporaryFolder.h"

using namespace quadmap;
using mrpt::config::CConfigFileMemory;

namespace
{
void expectParts(const std::string& error, const std::vector<std::string>& parts)
{
  for (const auto& part : parts)
    EXPECT_NE(error.find(part), std::string::npos) << "no \"" << part << "\" in: " << error;
}
}  // namespace

TEST(ParseNumber, TakesWholeTextsOnly)
{
  EXPECT_EQ(parseNumber("4"), 4.0);
  EXPECT_EQ(parseNumber(" -2.5e-3\t"), -2.5e-3);
  EXPECT_EQ(parseNumber("+7"), 7.0);
  EXPECT_TRUE(std::isnan(parseNumber("nan").value()));
  for (const char* bad : {"", " ", "4abc", "ten", "1,5", "1 2", "+-1", "0x10", "--1", "1e999"})
    EXPECT_FALSE(parseNumber(bad)) << bad;
}

TEST(ReadNumber, ReadsChecksAndLeavesMissingKeysAlone)
{
  const CConfigFileMemory config(std::string("[s]\na = 2.5 // metres\nb = 7\n"));
  double a = 0, missing = 9;
  double b = 0, alsoMissing = 8;
  readNumber(config, "s", "a", a, 0, 10);
  readNumber(config, "s", "b", b, 0, 10);
  readNumber(config, "s", "c", missing, 0, 10);
  readNumber(config, "other", "b", alsoMissing, 0, 10);
  EXPECT_EQ(a, 2.5);
  EXPECT_EQ(b, 7);
  EXPECT_EQ(missing, 9);
  EXPECT_EQ(alsoMissing, 8);
}

TEST(ReadNumber, BadValuesNameSectionKeyValueAndBounds)
{
  for (const char* bad : {"4abc", "ten", "", "11", "-0.1", "nan", "inf"})
  {
    const CConfigFileMemory config(std::string("[sec]\nrange = ") + bad + "\n");
    double value = 5;
    const auto error = errorOf([&] { readNumber(config, "sec", "range", value, 0, 10); });
    expectParts(error, {"[sec]", "range=" + std::string(bad), "[0, 10]"});
    EXPECT_EQ(value, 5) << "untouched by a bad value";
  }
}

TEST(ReadFlag, KnowsSixWordsAndNoOther)
{
  for (const auto& [word, expected] : std::vector<std::pair<std::string, bool>>{
           { "true",  true},
           {  "Yes",  true},
           {    "1",  true},
           {"false", false},
           {   "NO", false},
           {    "0", false}
  })
  {
    const CConfigFileMemory config("[s]\nf = " + word + "\n");
    bool flag = !expected;
    readFlag(config, "s", "f", flag);
    EXPECT_EQ(flag, expected) << word;
  }
  const CConfigFileMemory config(std::string("[s]\nf = yess\n"));
  bool flag = true;
  expectParts(errorOf([&] { readFlag(config, "s", "f", flag); }), {"[s]", "f=yess"});
  readFlag(config, "s", "missing", flag);
  EXPECT_TRUE(flag);
}

TEST(RejectUnknownKeys, NamesTheKeyAndTheKnownOnes)
{
  const CConfigFileMemory config(std::string("[s]\nMaxRange = 1\nmaxRnge = 2\n"));
  expectParts(
      errorOf([&] { rejectUnknownKeys(config, "s", {"maxRange"}); }),
      {"[s]", "maxRnge", "maxRange"});
  EXPECT_NO_THROW(rejectUnknownKeys(config, "s", {"maxRange", "maxRnge"}));
  EXPECT_NO_THROW(rejectUnknownKeys(config, "missing", {}));
}

TEST(RequireReadableIni, AcceptsWhatMrptReads)
{
  const TemporaryFolder folder;
  EXPECT_NO_THROW(requireReadableIni(folder.write(
      "good.ini",
      "; comment\n# comment\n// comment\n\n[a b]\nx = 1\ny = 1 2 \\\n  3 "
      "4\n[c]\nx=1\n")));
}

TEST(RequireReadableIni, RefusesWhatMrptWouldSilentlyDrop)
{
  const TemporaryFolder folder;
  std::vector<std::pair<std::string, std::string>> cases = {
      {           "[a]\nx 1\n",    ":2: expected"},
      {           "[a]\n= 1\n",    ":2: expected"},
      {          "[a\nx = 1\n",       ":1: \"]\""},
      {"[a]\nx = 1\n\nX = 2\n",   ":4: key \"x\""},
      { "[a]\nx=1\n[b]\n[A]\n", ":4: section [a]"},
  };
  cases.emplace_back(std::string("[a]\nx=1\0\n[b]\n", 13), ":2: has a zero byte");
  for (const auto& [text, expected] : cases)
  {
    const auto path = folder.write("bad.ini", text);
    expectParts(errorOf([&] { requireReadableIni(path); }), {path, expected});
  }
}

TEST(RequireReadableIni, RefusesWhatMrptWouldRun)
{
  const TemporaryFolder folder;
  for (const char* line :
       {"@define a 1", "x = 1 @define a 2", "; c\r@define a 1", "x = ${a}", "x = $env{HOME}",
        "; $eval{repeat 1 until (0)}", "x = $eval{repeat 1 until (0)}"})
  {
    const auto path = folder.write("bad.ini", std::string("[a]\n") + line + "\n");
    expectParts(errorOf([&] { requireReadableIni(path); }), {path, ":2: ", "not allowed"});
  }
  const auto path = folder.write("good.ini", "[a]\nx = $5, me@example.org {1}\n");
  EXPECT_EQ(errorOf([&] { requireReadableIni(path); }), "");
}

TEST(RequireReadableIni, RefusesMissingFilesAndFolders)
{
  const TemporaryFolder folder;
  expectParts(
      errorOf([&] { requireReadableIni(folder.path("none.ini")); }),
      {"none.ini", "cannot be read"});
  expectParts(errorOf([&] { requireReadableIni(folder.folder().string()); }), {"is a directory"});
}
