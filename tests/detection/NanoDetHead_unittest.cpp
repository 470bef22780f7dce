#include <gtest/gtest.h>

#include "HandMadeTensor.h"
#include "heads/HeadChoice.h"

using namespace quadmap;

namespace
{
constexpr int kNanoDetLabels = 5, kBins = 8;

/** Outputs for an input of 64x32, in an order as no network has it. */
class NanoDetOutputs : public ::testing::Test
{
 protected:
  NanoDetOutputs()
  {
    for (const int cells : {8, 2, 32})
    {
      outputs_.emplace_back(Shape{cells, 4 * kBins});
      outputs_.emplace_back(Shape{cells, kNanoDetLabels});
    }
    request_.width = 64;
    request_.height = 32;
    request_.labels = kNanoDetLabels;
    for (const auto& output : outputs_) request_.shapes.push_back(output.shape);
  }
  /** Of the grid with 32 cells. */
  HandMadeTensor& sides() { return outputs_[4]; }
  HandMadeTensor& scores() { return outputs_[5]; }

  std::vector<RawBox> rawBoxes(float minScore) const
  {
    const auto [kind, head] = chooseHead(request_);
    EXPECT_EQ(kind, HeadKind::NanoDet);
    std::vector<Tensor> tensors;
    for (const auto& output : outputs_) tensors.push_back(output.tensor());
    return head->rawBoxes(tensors, minScore);
  }

  std::vector<HandMadeTensor> outputs_;
  HeadRequest request_;
};
}  // namespace

TEST_F(NanoDetOutputs, GiveBoxesAroundTheCentresOfCells)
{
  const int cell = 10;  // column 2, row 1: centre (2.5 * 8 - 0.5, 1.5 * 8 - 0.5) = (19.5, 11.5)
  scores().at(cell, 3) = 0.7f;
  scores().at(cell, 1) = 0.6f;
  for (int side = 0; side < 4; ++side)
    sides().at(cell, side * kBins + side) = 50;  // all in one bin: 0, 1, 2, 3 cells
  const auto found = rawBoxes(0.5f);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].label, 3u);
  EXPECT_FLOAT_EQ(found[0].score, 0.7f);
  EXPECT_NEAR(found[0].box.x1, 19.5, 1e-9);
  EXPECT_NEAR(found[0].box.y1, 11.5 - 8, 1e-9);
  EXPECT_NEAR(found[0].box.x2, 19.5 + 16, 1e-9);
  EXPECT_NEAR(found[0].box.y2, 11.5 + 24, 1e-9);
}

TEST_F(NanoDetOutputs, TakeTheMeanOfTheBins)
{
  scores().at(0, 0) = 0.9f;  // all bins are equal: (0 + ... + 7) / 8 = 3.5 cells
  const auto found = rawBoxes(0.5f);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].box.x1, 3.5 - 28, 1e-9);
  EXPECT_NEAR(found[0].box.y2, 3.5 + 28, 1e-9);
}

TEST_F(NanoDetOutputs, HaveTheSizeOfTheirGrid)
{
  outputs_[3].at(1, 2) = 0.9f;  // stride 32, column 1: centre (47.5, 15.5)
  for (int side = 0; side < 4; ++side) outputs_[2].at(1, side * kBins + 1) = 50;
  const auto found = rawBoxes(0.5f);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].box.x1, 15.5, 1e-9);
  EXPECT_NEAR(found[0].box.x2, 79.5, 1e-9);
  EXPECT_NEAR(found[0].box.y1, -16.5, 1e-9);
}

TEST_F(NanoDetOutputs, AreRefusedWhenNothingTellsScoresFromSides)
{
  request_.labels = 4 * kBins;
  for (auto& shape : request_.shapes) shape[1] = 4 * kBins;
  EXPECT_THROW(chooseHead(request_), std::runtime_error);
}
