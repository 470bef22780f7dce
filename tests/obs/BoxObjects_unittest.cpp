#include "quadmap/obs/BoxObjects.h"

#include <gtest/gtest.h>

#include "TemporaryFolder.h"

using namespace quadmap;

namespace
{
std::string reportWith(const std::string& object)
{
  return R"({"associations": [{"time": 1000.25, "sensor": "a", "boxes": [{"object": )" + object +
         R"(}, {"object": null}]}]})";
}
}  // namespace

TEST(BoxObjects, AreThoseOfTheKeyframe)
{
  const TemporaryFolder folder;
  const BoxObjects boxes(folder.write("report.json", reportWith("7")));
  const std::vector<std::optional<unsigned>> expected{7u, std::nullopt};
  EXPECT_EQ(boxes.of("a", 1000.25), expected);
  EXPECT_TRUE(boxes.of("b", 1000.25).empty());
  EXPECT_TRUE(boxes.of("a", 1000.35).empty());
}

TEST(BoxObjects, AreRefusedWhenAnIdIsNone)
{
  const TemporaryFolder folder;
  for (const char* object : {"-1", "1.5", "1e300", "4294967296", "true", "\"7\""})
  {
    const auto path = folder.write("report.json", reportWith(object));
    EXPECT_EQ(errorOf([&] { BoxObjects boxes(path); }).find(path + ": "), 0u) << object;
  }
}
