#include <gtest/gtest.h>

#include <cmath>

#include "HandMadeTensor.h"
#include "heads/HeadChoice.h"

using namespace quadmap;

namespace
{
constexpr int kCellsOfInput =
    32 + 8 + 2;  // of an input of 64x32, at distances of 8, 16 and 32 pixels

std::vector<RawBox> rawBoxes(
    HeadKind expected,
    const std::vector<HandMadeTensor>& outputs,
    std::size_t labels,
    float minScore,
    HeadKind asked = HeadKind::Auto)
{
  HeadRequest request{asked, {}, 64, 32, labels};
  std::vector<Tensor> tensors;
  for (const auto& output : outputs)
  {
    request.shapes.push_back(output.shape);
    tensors.push_back(output.tensor());
  }
  const auto [kind, head] = chooseHead(request);
  EXPECT_EQ(kind, expected);
  return head->rawBoxes(tensors, minScore);
}

void expectBox(const ImageBox& box, double x1, double y1, double x2, double y2)
{
  constexpr double kFloat = 1e-4;  // numbers of 32 bits
  EXPECT_NEAR(box.x1, x1, kFloat);
  EXPECT_NEAR(box.y1, y1, kFloat);
  EXPECT_NEAR(box.x2, x2, kFloat);
  EXPECT_NEAR(box.y2, y2, kFloat);
}
}  // namespace

TEST(YoloxOutputs, CountInCells)
{
  HandMadeTensor table({kCellsOfInput, 5 + 3});
  const int anchor = 32 + 5;  // stride 16, column 1, row 1
  table.at(anchor, 0) = 0.25f;
  table.at(anchor, 1) = -0.5f;
  table.at(anchor, 2) = std::log(2.0f);
  table.at(anchor, 3) = std::log(0.5f);
  table.at(anchor, 4) = 0.8f;
  table.at(anchor, 5 + 2) = 0.5f;
  table.at(3, 4) = 0.3f;  // its class is as unsure
  table.at(3, 5) = 0.9f;
  const auto found = rawBoxes(HeadKind::Yolox, {table}, 3, 0.35f);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].label, 2u);
  EXPECT_FLOAT_EQ(found[0].score, 0.4f);
  expectBox(found[0].box, 20 - 16, 8 - 4, 20 + 16, 8 + 4);  // centre (1.25, 0.5) * 16
}

TEST(YoloxOutputs, ReachIntoEachGrid)
{
  for (const auto& [anchor, x, y] : {
           std::tuple(0, 0, 0), {31, 56, 24},
              {39, 48, 16},
              {41, 32,  0}
  })
  {
    HandMadeTensor table({kCellsOfInput, 5 + 1});
    table.at(anchor, 4) = table.at(anchor, 5) = 1;
    const auto found = rawBoxes(HeadKind::Yolox, {table}, 1, 0.5f);
    ASSERT_EQ(found.size(), 1u) << anchor;
    EXPECT_NEAR(found[0].box.centerX(), x, 1e-6) << anchor;
    EXPECT_NEAR(found[0].box.centerY(), y, 1e-6) << anchor;
  }
}

TEST(Yolov5Outputs, CountInPixels)
{
  HandMadeTensor table({3 * kCellsOfInput, 5 + 2});
  const float row[] = {30, 20, 10, 8, 0.9f, 0.1f, 0.8f};
  std::copy(std::begin(row), std::end(row), &table.at(100, 0));
  const auto found = rawBoxes(HeadKind::Yolov5, {table}, 2, 0.5f);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].label, 1u);
  EXPECT_FLOAT_EQ(found[0].score, 0.72f);
  expectBox(found[0].box, 25, 16, 35, 24);
}

TEST(Yolov8Outputs, HaveABoxInEachColumn)
{
  HandMadeTensor table({4 + 3, kCellsOfInput});
  const float column[] = {30, 20, 10, 8, 0.2f, 0.6f, 0.5f};
  for (int i = 0; i < 7; ++i) table.at(i, 17) = column[i];
  const auto found = rawBoxes(HeadKind::Yolov8, {table}, 3, 0.25f);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].label, 1u);
  EXPECT_FLOAT_EQ(found[0].score, 0.6f);
  EXPECT_TRUE(found[0].maskCoefficients.empty());
  expectBox(found[0].box, 25, 16, 35, 24);
}

TEST(Yolov8Outputs, HaveCoefficientsOfMasks)
{
  HandMadeTensor table({4 + 3 + 2, kCellsOfInput}), prototypes({2, 8, 16});
  table.at(4, 1) = 0.9f;
  table.at(7, 1) = -3;
  table.at(8, 1) = 5;
  for (const auto& outputs : {
           std::vector{     table, prototypes},
           std::vector{prototypes,      table}
  })
  {
    const auto found = rawBoxes(HeadKind::Yolov8, outputs, 3, 0.5f);
    ASSERT_EQ(found.size(), 1u) << "in whatever order the outputs come";
    EXPECT_EQ(found[0].label, 0u);
    EXPECT_EQ(found[0].maskCoefficients, (std::vector<float>{-3, 5}));
  }
}

TEST(DarknetOutputs, AreSharesOfTheInput)
{
  HandMadeTensor coarse({6, 5 + 2}), fine({24, 5 + 2});
  const float row[] = {0.5f, 0.25f, 0.125f, 0.5f, 0.9f, 0.1f, 0.6f};
  std::copy(std::begin(row), std::end(row), &fine.at(7, 0));
  const auto found = rawBoxes(HeadKind::Darknet, {coarse, fine}, 2, 0.3f, HeadKind::Darknet);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].label, 1u);
  EXPECT_FLOAT_EQ(found[0].score, 0.6f) << "objectness is in the score already";
  expectBox(found[0].box, 32 - 4, 8 - 8, 32 + 4, 8 + 8);
}

TEST(DenseOutputs, OfNoNumberGiveNoBox)
{
  HandMadeTensor table({4 + 1, kCellsOfInput}, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(rawBoxes(HeadKind::Yolov8, {table}, 1, 0.25f).empty());
  HandMadeTensor rows({kCellsOfInput, 5 + 1}, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(rawBoxes(HeadKind::Yolox, {rows}, 1, 0.25f).empty());
  EXPECT_TRUE(rawBoxes(HeadKind::Darknet, {rows}, 1, 0.25f, HeadKind::Darknet).empty());
}
