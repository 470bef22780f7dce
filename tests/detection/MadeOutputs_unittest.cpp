#include <gtest/gtest.h>

#include <random>

#include "HandMadeTensor.h"
#include "PlainDecoders.h"
#include "heads/HeadChoice.h"

using namespace quadmap;

// Outputs of random numbers, decoded by the heads and by the plain decoders.
namespace
{
constexpr int kLabels = 7, kCoefficients = 3;
constexpr int kCells = 96 * 64 / 64 + 96 * 64 / 256 + 96 * 64 / 1024;  // of kInput
const cv::Size kInput(96, 64);
constexpr float kMinMadeScore = 0.4F;

/** A table of random numbers between `low` and `high`. */
HandMadeTensor randomTensor(const Shape& shape, std::mt19937& random, double low, double high)
{
  HandMadeTensor tensor(shape);
  for (float& number : tensor.numbers)
    number = static_cast<float>(low + (high - low) * static_cast<double>(random()) / 0xFFFFFFFF);
  return tensor;
}

plain::Table tableOf(const HandMadeTensor& tensor)
{
  return {tensor.numbers.data(), tensor.shape[0], tensor.shape[1]};
}

std::vector<RawBox> decoded(
    HeadKind kind, const std::vector<HandMadeTensor>& outputs, HeadKind asked = HeadKind::Auto)
{
  HeadRequest request{asked, {}, kInput.width, kInput.height, kLabels};
  std::vector<Tensor> tensors;
  for (const auto& output : outputs)
  {
    request.shapes.push_back(output.shape);
    tensors.push_back(output.tensor());
  }
  const auto [chosen, head] = chooseHead(request);
  EXPECT_EQ(chosen, kind);
  return head->rawBoxes(tensors, kMinMadeScore);
}

void expectEqual(const std::vector<RawBox>& found, const std::vector<PlainBox>& wanted)
{
  constexpr double kFloat = 1e-3;  // boxes of up to 1000 pixels, in numbers of 32 bits
  ASSERT_EQ(found.size(), wanted.size());
  EXPECT_GT(wanted.size(), 5u) << "there is something to compare";
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    EXPECT_EQ(static_cast<int>(found[i].label), wanted[i].label) << i;
    EXPECT_NEAR(static_cast<double>(found[i].score), wanted[i].score, 1e-6) << i;
    EXPECT_NEAR(found[i].box.x1, wanted[i].x1, kFloat) << i;
    EXPECT_NEAR(found[i].box.y1, wanted[i].y1, kFloat) << i;
    EXPECT_NEAR(found[i].box.x2, wanted[i].x2, kFloat) << i;
    EXPECT_NEAR(found[i].box.y2, wanted[i].y2, kFloat) << i;
    ASSERT_EQ(found[i].maskCoefficients.size(), wanted[i].coefficients.size());
    for (std::size_t k = 0; k < wanted[i].coefficients.size(); ++k)
      EXPECT_EQ(static_cast<double>(found[i].maskCoefficients[k]), wanted[i].coefficients[k]);
  }
}

class MadeOutputs : public ::testing::TestWithParam<unsigned>
{
 protected:
  std::mt19937 random_{GetParam()};
};
}  // namespace

TEST_P(MadeOutputs, OfYoloxAreDecodedByItsFormulas)
{
  const auto table = randomTensor({kCells, 5 + kLabels}, random_, 0, 1);
  expectEqual(
      decoded(HeadKind::Yolox, {table}),
      plain::yolox(tableOf(table), kInput, double(kMinMadeScore)));
}

TEST_P(MadeOutputs, OfYolov5AreDecodedByItsFormulas)
{
  const auto table = randomTensor({3 * kCells, 5 + kLabels}, random_, 0, 1);
  expectEqual(
      decoded(HeadKind::Yolov5, {table}), plain::yolov5(tableOf(table), double(kMinMadeScore)));
}

TEST_P(MadeOutputs, OfYolov8WithMasksAreDecodedByItsFormulas)
{
  const auto table = randomTensor({4 + kLabels + kCoefficients, kCells}, random_, -1, 0.5);
  expectEqual(
      decoded(HeadKind::Yolov8, {table, HandMadeTensor({kCoefficients, 16, 24})}),
      plain::yolov8(tableOf(table), kCoefficients, double(kMinMadeScore)));
}

TEST_P(MadeOutputs, OfNanoDetAreDecodedByItsFormulas)
{
  std::vector<HandMadeTensor> outputs;
  std::vector<PlainBox> wanted;
  for (const int stride : {8, 16, 32})
  {
    const int cells = kInput.area() / (stride * stride);
    outputs.push_back(randomTensor({cells, kLabels}, random_, -1, 0.6));
    outputs.push_back(randomTensor({cells, 4 * 8}, random_, -4, 4));
    const auto boxes = plain::nanoDet(
        tableOf(outputs[outputs.size() - 2]), tableOf(outputs.back()), kInput, stride,
        double(kMinMadeScore));
    wanted.insert(wanted.end(), boxes.begin(), boxes.end());
  }
  expectEqual(decoded(HeadKind::NanoDet, outputs), wanted);
}

TEST_P(MadeOutputs, OfDarknetAreDecodedByItsFormulas)
{
  const auto coarse = randomTensor({18, 5 + kLabels}, random_, 0, 1);
  const auto fine = randomTensor({72, 5 + kLabels}, random_, 0, 1);
  auto wanted = plain::darknetTable(tableOf(coarse), kInput, double(kMinMadeScore));
  const auto more = plain::darknetTable(tableOf(fine), kInput, double(kMinMadeScore));
  wanted.insert(wanted.end(), more.begin(), more.end());
  expectEqual(decoded(HeadKind::Darknet, {coarse, fine}, HeadKind::Darknet), wanted);
}

INSTANTIATE_TEST_SUITE_P(Seeds, MadeOutputs, ::testing::Values(1u, 2u, 3u));
