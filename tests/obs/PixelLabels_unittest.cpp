#include "quadmap/obs/PixelLabels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "TemporaryFolder.h"

using namespace quadmap;
using mrpt::obs::CObservation3DRangeScan;

namespace
{
/** Labels as text: a row per string, a letter per label ('a' is bit 0), '.' for none. */
CObservation3DRangeScan labelledScan(
    const std::vector<std::string>& rows, const std::map<std::uint32_t, std::string>& names)
{
  CObservation3DRangeScan scan;
  scan.timestamp = mrpt::Clock::fromDouble(12.5);
  scan.sensorLabel = "RGBD_1";
  scan.sensorPose = mrpt::poses::CPose3D(0.1, 0.2, 0.3, 0.4, 0.5, 0.6);
  scan.cameraParams.nrows = static_cast<unsigned>(rows.size());
  scan.cameraParams.ncols = static_cast<unsigned>(rows[0].size());
  scan.pixelLabels = std::make_shared<mrpt::obs::TPixelLabelInfo<1>>();
  scan.pixelLabels->setSize(static_cast<int>(rows.size()), static_cast<int>(rows[0].size()));
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < rows[r].size(); ++c)
      if (rows[r][c] != '.')
        scan.pixelLabels->setLabel(
            static_cast<int>(r), static_cast<int>(c), static_cast<std::uint8_t>(rows[r][c] - 'a'));
  scan.pixelLabels->pixelLabelNames = names;
  return scan;
}

class PixelLabels : public ::testing::Test
{
 protected:
  CObservationObjects::Ptr boxesOf(const CObservation3DRangeScan& scan, int minPixels = 1)
  {
    return boxesFromPixelLabels(scan, LabelTable::installed(), minPixels, unknown_);
  }
  std::set<std::string> unknown_;
};

void expectBox(const DetectedObject& object, const ImageBox& box)
{
  EXPECT_EQ(object.box.x1, box.x1);
  EXPECT_EQ(object.box.y1, box.y1);
  EXPECT_EQ(object.box.x2, box.x2);
  EXPECT_EQ(object.box.y2, box.y2);
}
}  // namespace

TEST_F(PixelLabels, ConnectedPixelsOfALabelAreAnObject)
{
  const auto scan = labelledScan(
      {
          "aa.....b", //
          "a....bbb", //
          ".a......", // touches the first by a corner
          "....aa..", //
          "....aa.."
  },
      {{0, "chair"}, {1, "cup"}});
  const auto boxes = boxesOf(scan);
  ASSERT_TRUE(boxes);
  EXPECT_EQ(boxes->timestamp, scan.timestamp);
  EXPECT_EQ(boxes->sensorLabel, "RGBD_1");
  EXPECT_EQ(boxes->sensorPose, scan.sensorPose);
  EXPECT_EQ(boxes->cameraParams, scan.cameraParams);
  ASSERT_EQ(boxes->objects.size(), 3u);
  const auto& [first, second, cup] =
      std::tie(boxes->objects[0], boxes->objects[1], boxes->objects[2]);
  expectBox(first, {0, 0, 1, 2});
  expectBox(second, {4, 3, 5, 4});
  expectBox(cup, {5, 0, 7, 1});
  EXPECT_EQ(first.label, "chair");
  EXPECT_EQ(cup.label, "cup");
  EXPECT_EQ(cup.score, 1);
  EXPECT_FALSE(cup.instanceId);
  ASSERT_TRUE(cup.mask);
  for (unsigned y = 0; y < 5; ++y)
    for (unsigned x = 0; x < 8; ++x)
      EXPECT_EQ(cup.mask->contains(x, y), (y == 0 && x == 7) || (y == 1 && x >= 5))
          << x << " " << y;
  EXPECT_TRUE(unknown_.empty());
}

TEST_F(PixelLabels, AnInstanceIsOneObjectInSeveralParts)
{
  const auto boxes = boxesOf(labelledScan(
      {
          "aa.bb.aa", //
          "aa.bb.aa"
  },
      {{0, "chair_2"}, {1, "chair_3"}}));
  ASSERT_EQ(boxes->objects.size(), 2u);
  expectBox(boxes->objects[0], {0, 0, 7, 1});
  EXPECT_TRUE(boxes->objects[0].mask->contains(6, 0));
  EXPECT_FALSE(boxes->objects[0].mask->contains(3, 0)) << "the chair in between";
  ASSERT_TRUE(boxes->objects[0].instanceId && boxes->objects[1].instanceId);
  EXPECT_NE(*boxes->objects[0].instanceId, *boxes->objects[1].instanceId);
  const auto later = boxesOf(labelledScan(
      {
          "...cc", //
          "...cc"
  },
      {{2, "chair_2"}}));
  EXPECT_EQ(later->objects.at(0).instanceId, boxes->objects[0].instanceId)
      << "another bit, the same name";
}

TEST_F(PixelLabels, APixelMayHaveSeveralLabels)
{
  auto scan = labelledScan(
      {
          "aaaa", //
          "aaaa", //
          "aaaa"
  },
      {{0, "dining table"}, {7, "cup"}});
  for (const int row : {0, 1})
    for (const int column : {1, 2}) scan.pixelLabels->setLabel(row, column, 7);
  const auto boxes = boxesOf(scan);
  ASSERT_EQ(boxes->objects.size(), 2u);
  expectBox(boxes->objects[0], {0, 0, 3, 2});
  EXPECT_TRUE(boxes->objects[0].mask->contains(1, 0)) << "the table goes on under the cup";
  expectBox(boxes->objects[1], {1, 0, 2, 1});
}

TEST_F(PixelLabels, WhatTheTableDoesNotKnowIsNoObject)
{
  const auto boxes = boxesOf(labelledScan(
      {
          "aabbcc", //
          "aabbcc"
  },
      {{0, "wall_1"}, {1, "wall_2"}, {3, "chair"}}));
  EXPECT_TRUE(boxes->objects.empty());
  EXPECT_EQ(unknown_, (std::set<std::string>{"labels without a name", "wall"}));
}

TEST_F(PixelLabels, TinyGroupsAreIgnored)
{
  const std::vector<std::string> rows = {
      "aa.bbb.aaaa",  //
      "aa.....aaaa"};
  const std::map<std::uint32_t, std::string> names = {
      {0, "chair_1"},
      {1,     "cup"}
  };
  const auto boxes = boxesOf(labelledScan(rows, names), 5);
  ASSERT_EQ(boxes->objects.size(), 1u);
  expectBox(boxes->objects[0], {7, 0, 10, 1});
  EXPECT_EQ(boxesOf(labelledScan(rows, names), 9)->objects.size(), 0u);
  EXPECT_EQ(boxesOf(labelledScan(rows, names), 1)->objects.size(), 1u)
      << "a line of pixels has no area";
}

TEST_F(PixelLabels, OtherSizesAreScaled)
{
  auto scan = labelledScan(
      {
          "....", //
          ".aa.", //
          "...."
  },
      {{0, "cup"}});
  scan.cameraParams.ncols = 16;
  scan.cameraParams.nrows = 12;
  const auto boxes = boxesOf(scan, 32);
  ASSERT_EQ(boxes->objects.size(), 1u);
  expectBox(boxes->objects[0], {4, 4, 11, 7});
  EXPECT_TRUE(boxesOf(scan, 33)->objects.empty()) << "pixels of the depth image count";
  scan.cameraParams.nrows = 16;
  EXPECT_EQ(
      errorOf([&] { boxesOf(scan); }), "its 4x3 pixel labels do not fit its 16x16 depth image");
}

TEST_F(PixelLabels, NoLabelsAreNotAnEmptyImage)
{
  CObservation3DRangeScan scan;
  EXPECT_FALSE(boxesOf(scan)) << "nobody looked";
  const auto boxes = boxesOf(labelledScan({"..", ".."}, {}));
  ASSERT_TRUE(boxes) << "somebody looked and found nothing";
  EXPECT_TRUE(boxes->objects.empty());
}

TEST_F(PixelLabels, UpTo64LabelsAreRead)
{
  auto scan = labelledScan({"..", ".."}, {});
  scan.pixelLabels = std::make_shared<mrpt::obs::TPixelLabelInfo<8>>();
  scan.pixelLabels->setSize(2, 2);
  scan.pixelLabels->pixelLabelNames[63] = "cup";
  scan.pixelLabels->pixelLabelNames[64] = "chair";  // there is no such bit
  for (const int row : {0, 1})
    for (const int column : {0, 1}) scan.pixelLabels->setLabel(row, column, 63);
  EXPECT_EQ(boxesOf(scan)->objects.size(), 1u);
}

TEST_F(PixelLabels, OfTooManySeparatePartsTheLargestAreKept)
{
  std::vector<std::string> rows;  // 40 x 40 squares of two pixels, those of the last row of three
  for (int row = 0; row < 121; ++row)
  {
    rows.emplace_back(120, '.');
    for (std::size_t column = 0; column < 120; ++column)
      if ((row % 3 != 2 || row == 119) && column % 3 != 2) rows.back()[column] = 'a';
  }
  rows.back() = std::string(120, '.');
  const auto scan = labelledScan(
      rows, {
                {0, "chair"}
  });
  std::set<std::string> unknown;
  std::size_t leftOut = 0;
  const auto boxes = boxesFromPixelLabels(scan, LabelTable::installed(), 1, unknown, &leftOut);
  EXPECT_EQ(leftOut, 1300u);
  ASSERT_EQ(boxes->objects.size(), 300u);
  const auto isHigh = [](const DetectedObject& object) { return object.box.height() == 2; };
  EXPECT_EQ(std::count_if(boxes->objects.begin(), boxes->objects.end(), isHigh), 40);
  EXPECT_EQ(boxes->objects.front().box.y1, 0) << "of equal ones the first";
  EXPECT_TRUE(boxesOf(scan, 7)->objects.empty());
}

TEST_F(PixelLabels, OfSeveralLabelsWithTooManyPartsTheLargestAreKept)
{
  std::vector<std::string> rows(60, std::string(120, '.'));
  for (std::size_t row = 0; row < 60; ++row)
    for (std::size_t column = 0; column < 120; ++column)
      if (row % 4 < 3 && column % 3 != 2) rows[row][column] = row < 48 ? 'a' : 'b';
  for (std::size_t row = 0; row < 48; row += 4) rows[row] = std::string(120, '.');  // 480 of 2 x 2
  const auto scan = labelledScan(
      rows, {
                {0, "chair"},
                {1,   "cup"}
  });
  const auto boxes = boxesOf(scan);
  const auto isCup = [](const DetectedObject& object) { return object.label == "cup"; };
  EXPECT_EQ(boxes->objects.size(), 300u);
  EXPECT_EQ(std::count_if(boxes->objects.begin(), boxes->objects.end(), isCup), 120);
}
