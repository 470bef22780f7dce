#include "quadmap/obs/LabelColor.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

using namespace quadmap;

TEST(LabelColor, UsualIndoorLabelsHaveColoursOfTheirOwn)
{
  const auto labels = {"chair", "couch",    "dining table", "tv",     "potted plant",
                       "cup",   "bed",      "refrigerator", "laptop", "bottle",
                       "book",  "suitcase", "vase",         "sink"};
  std::set<std::tuple<int, int, int>> colors;
  for (const char* label : labels)
  {
    const auto c = labelColor(label);
    colors.insert({c.R, c.G, c.B});
  }
  EXPECT_EQ(colors.size(), labels.size());
}

TEST(LabelColor, DependsOnTheTextAlone)
{
  // Pictures made by different versions must be comparable: these values do not change.
  EXPECT_EQ(labelColor("chair"), mrpt::img::TColor(0xe0, 0x6c, 0x00));
  EXPECT_EQ(labelColor("couch"), mrpt::img::TColor(0xd0, 0x27, 0x28));
  EXPECT_EQ(labelColor("chair", 90), mrpt::img::TColor(0xe0, 0x6c, 0x00, 90));
  EXPECT_EQ(labelColor("").A, 255);
}
