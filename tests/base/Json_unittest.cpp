#include "quadmap/base/Json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "../obs/TemporaryFolder.h"

namespace quadmap
{
namespace
{
TEST(ReadJson, NamesTheFileAndThePlaceOfWhatIsWrong)
{
  const TemporaryFolder folder;
  EXPECT_EQ(readJson(folder.write("a.json", "{\"b\": [1, 2]}"))["b"][1], 2);
  const auto path = folder.write("bad.json", "{\"a\": 1,\n b}");
  const std::string error = errorOf([&] { readJson(path); });
  EXPECT_EQ(error.find(path + ": "), 0u) << error;
  EXPECT_NE(error.find("line 2, column 2"), std::string::npos) << error;
  EXPECT_EQ(error.find("json.exception"), std::string::npos) << error;
  EXPECT_NE(
      errorOf([&] { readJson("/nowhere/x.json"); }).find("cannot be read"), std::string::npos);
}

TEST(ReadJson, RefusesWhatFollowsAZeroByte)
{
  const TemporaryFolder folder;
  const auto path = folder.write("a.json", std::string("{\"b\": 1}\n\0{\"b\": 2}", 19));
  EXPECT_EQ(errorOf([&] { readJson(path); }), path + ": has a zero byte");
}

TEST(ReadJson, RefusesKeysThatStandTwice)
{
  const TemporaryFolder folder;
  const auto errorIn = [&](const std::string& text)
  {
    const auto path = folder.write("a.json", text);
    return errorOf([&] { readJson(path); });
  };
  for (const char* text :
       {R"({"a": [{"id": 1}, {"id": 2}], "b": {"a": 1}, "c": {}})", R"([{"a": {"a": {"a": 1}}}])"})
    EXPECT_EQ(errorIn(text), "") << text;
  for (const char* text :
       {R"({"id": 1, "b": {"id": 2}, "id": 3})", R"([{"a": 1}, {"id": [], "id": []}])"})
    EXPECT_EQ(errorIn(text), folder.path("a.json") + ": the key 'id' stands twice in an object");
}

TEST(ReadJson, RefusesTreesThatTakeMoreMemoryThanTheirText)
{
  const TemporaryFolder folder;
  const auto nested = [&](int depth)
  { return folder.write("x.json", std::string(depth, '[') + std::string(depth, ']')); };
  EXPECT_EQ(errorOf([&] { readJson(nested(64)); }), "");
  EXPECT_NE(errorOf([&] { readJson(nested(65)); }).find("nested too deeply"), std::string::npos);
  for (const auto& [item, most] : {std::pair("0", 17'500'000), std::pair("{\"a\":{}}", 3'130'000)})
  {
    std::string items = std::string("[") + item;
    for (int i = 1; i <= most; ++i) items += std::string(",") + item;
    const auto many = folder.write("x.json", items + "]");
    EXPECT_NE(errorOf([&] { readJson(many); }).find("too many values"), std::string::npos) << item;
  }
}

TEST(ReadJson, RefusesObjectsWhoseKeysTakeMinutes)
{
  const TemporaryFolder folder;
  const auto objectOf = [](int keys)
  {
    std::string text = "{\"k\":[1,{}]";
    for (int i = 1; i < keys; ++i) text += ",\"" + std::to_string(i) + "\":0";
    return text + "}";
  };
  EXPECT_EQ(readJson(folder.write("x.json", objectOf(10'000))).size(), 10'000u);
  std::string list = "[" + objectOf(50);
  for (int i = 0; i < 10'000; ++i) list += "," + objectOf(50);
  EXPECT_EQ(errorOf([&] { readJson(folder.write("x.json", list + "]")); }), "")
      << "keys of other objects do not count";
  const auto many = folder.write("x.json", "{\"a\":" + objectOf(200'000) + "}");
  EXPECT_NE(errorOf([&] { readJson(many); }).find("too many keys"), std::string::npos);
  std::string longKeys = "{\"k\":0";
  for (int i = 0; i < 5'000; ++i)
    longKeys += ",\"" + std::string(2'000, 'k') + std::to_string(i) + "\":0";
  const auto slow = folder.write("x.json", longKeys + "}");
  EXPECT_NE(errorOf([&] { readJson(slow); }).find("too many keys"), std::string::npos)
      << "long keys take longer to compare";
}

TEST(WholeNumber, IsWhatTheFileSaysOrNothing)
{
  const auto number = [](const char* text) { return wholeNumber(Json::parse(text)); };
  EXPECT_EQ(number("-7"), -7);
  EXPECT_EQ(number("3.0"), 3) << "some programs write all numbers so";
  EXPECT_EQ(number("3e2"), 300);
  EXPECT_EQ(number("9223372036854775807"), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(number("-9223372036854775808.0"), std::numeric_limits<std::int64_t>::min());
  for (const char* none :
       {"1.5", "1e300", "-1e300", "9223372036854775808", "9223372036854775808.0", "true", "null",
        "\"3\"", "[3]"})
    EXPECT_FALSE(number(none)) << none;
}

TEST(JsonText, ReplacesWhatIsNotUtf8)
{
  EXPECT_EQ(
      jsonText(Json{
          {"z",         1},
          {"a", "caf\xe9"}
  }),
      "{\"z\":1,\"a\":\"caf\xef\xbf\xbd\"}");
}

TEST(Rounded, KeepsDecimalsAndHasNoNegativeZero)
{
  EXPECT_EQ(rounded(1.23456, 3).dump(), "1.235");
  EXPECT_EQ(rounded(-0.0001, 3).dump(), "0.0");
  EXPECT_TRUE(rounded(NAN, 3).is_null());
  EXPECT_TRUE(rounded(INFINITY, 3).is_null());
}

TEST(OrNull, IsNullWithoutANumber)
{
  EXPECT_TRUE(orNull(std::nullopt).is_null());
  EXPECT_EQ(orNull(0.5), 0.5);
}

}  // namespace
}  // namespace quadmap
