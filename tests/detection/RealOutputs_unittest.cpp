#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <opencv2/dnn.hpp>
#include <opencv2/imgcodecs.hpp>

#include "../obs/TemporaryFolder.h"
#include "KitchenModels.h"
#include "PlainDecoders.h"
#include "quadmap/detection/Detector.h"
#include "quadmap/folders/ClassNames.h"
#include "quadmap/obs/LabelTable.h"

using namespace quadmap;

// What detectors make of real images, against the outputs of the same networks in OpenCV, decoded
// by the plain decoders. The input, too, is made anew here.
namespace
{
constexpr double kMinScore = 0.25, kMaxOverlap = 0.45;  // of all three models
constexpr double kUnsure = 1e-3;                        // so near to kMinScore rounding decides

class RealOutputs : public KitchenModels
{
 protected:
  void SetUp() override
  {
    KitchenModels::SetUp();
    if (!IsSkipped()) names_ = readClassNames(models_ + "/coco.names");
  }

  std::string nameOf(const PlainBox& box) const
  {
    return labels_.canonical(names_.at(static_cast<std::size_t>(box.label)));
  }
  cv::Mat image(int number) const
  {
    return cv::imread(kitchen_ + cv::format("/rgb/frame-%06d.jpg", number));
  }

  /** The detected object that is this box; null when there is none. */
  const DetectedObject* matching(
      const std::vector<DetectedObject>& found,
      const PlainBox& box,
      const plain::Letterbox& place,
      cv::Size size) const
  {
    constexpr double kNear = 0.01;  // [px], and the score to a thousandth of it
    const auto near = [](double a, double b, double last)
    { return std::abs(a - std::clamp(b, 0.0, last)) < kNear; };
    const double right = size.width - 1, bottom = size.height - 1;
    for (const auto& o : found)
      if (labels_.canonical(o.label) == nameOf(box) && std::abs(o.score - box.score) < 1e-4 &&
          near(o.box.x1, place.imageX(box.x1), right) &&
          near(o.box.y1, place.imageY(box.y1), bottom) &&
          near(o.box.x2, place.imageX(box.x2), right) &&
          near(o.box.y2, place.imageY(box.y2), bottom))
        return &o;
    return nullptr;
  }

  /** Expects each box of one side on the other. */
  void expectSame(
      const std::vector<DetectedObject>& found,
      const std::vector<PlainBox>& wanted,
      const plain::Letterbox& place,
      cv::Size size)
  {
    std::size_t sure = 0;
    for (const auto& box : wanted)
    {
      if (box.score < kMinScore + kUnsure) continue;
      ++sure;
      EXPECT_TRUE(matching(found, box, place, size))
          << names_[std::size_t(box.label)] << " " << box.score;
    }
    const auto surelyFound = std::count_if(
        found.begin(), found.end(), [](const auto& o) { return o.score >= kMinScore + kUnsure; });
    EXPECT_EQ(static_cast<std::size_t>(surelyFound), sure);
    compared_ += sure;
  }

  std::vector<std::string> names_;
  LabelTable labels_ = LabelTable::installed();
  std::size_t compared_ = 0;  //!< Boxes in all images
};
}  // namespace

TEST_F(RealOutputs, OfYoloxAreDecodedByItsFormulas)
{
  const auto detector = loadDetector("yolox-nano");
  cv::dnn::Net net = cv::dnn::readNetFromONNX(models_ + "/yolox_nano.onnx");
  for (const int number : {0, 250, 480})
  {
    const cv::Mat bgr = image(number);
    const auto place = plain::letterboxed(bgr, {416, 416}, false, 114);
    net.setInput(cv::dnn::blobFromImage(place.canvas));
    const cv::Mat output = net.forward();
    ASSERT_EQ(output.dims, 3);
    const plain::Table table{output.ptr<float>(), output.size[1], output.size[2]};
    const auto wanted =
        plain::withoutOverlaps(plain::yolox(table, {416, 416}, kMinScore), kMaxOverlap);
    expectSame(detector->detect({bgr, mrpt::img::SHALLOW_COPY}), wanted, place, bgr.size());
  }
  EXPECT_GT(compared_, 5u);
}

TEST_F(RealOutputs, OfYoloFastestAreDecodedByTheFormulasOfDarknet)
{
  const auto detector = loadDetector("yolo-fastest-1.1-xl");
  const std::string stem = models_ + "/yolo-fastest-1.1-xl";
  cv::dnn::Net net = cv::dnn::readNetFromDarknet(stem + ".cfg", stem + ".weights");
  // Its anchors, as the .cfg has them: those of the layers 121 and 130.
  const std::vector<cv::Size2d> coarse{
      {115,  73},
      {119, 199},
      {242, 238}
  };
  const std::vector<cv::Size2d> fine{
      {12,  18},
      {37,  49},
      {52, 132}
  };
  const cv::Size input(320, 320);
  for (int number = 0; number <= 480; number += 60)
  {
    const cv::Mat bgr = image(number);
    const auto place = plain::stretched(bgr, input);
    net.setInput(cv::dnn::blobFromImage(place.canvas, 1 / 255.0, {}, {}, true));
    std::vector<cv::Mat> planes;
    net.forward(planes, std::vector<std::string>{"conv_120", "conv_129"});
    auto all = plain::darknet(planes[0], coarse, input, kMinScore);
    const auto more = plain::darknet(planes[1], fine, input, kMinScore);
    all.insert(all.end(), more.begin(), more.end());
    expectSame(
        detector->detect({bgr, mrpt::img::SHALLOW_COPY}), plain::withoutOverlaps(all, kMaxOverlap),
        place, bgr.size());
  }
  EXPECT_GT(compared_, 5u);
}

TEST_F(RealOutputs, OfYolov8SegAreDecodedByItsFormulas)
{
  const TemporaryFolder folder;
  const std::string file = folder.path("yolov8n-seg.onnx");
  const std::string unpack = "gunzip -c '" + models_ + "/yolov8n-seg.onnx.gz' > '" + file + "'";
  ASSERT_EQ(std::system(unpack.c_str()), 0);
  ::setenv("QUADMAP_MODELS", folder.folder().c_str(), 1);
  const auto detector = loadDetector("yolov8n-seg");
  cv::dnn::Net net = cv::dnn::readNetFromONNX(file);
  const cv::Mat bgr = image(250);
  const auto place = plain::letterboxed(bgr, {640, 640}, true, 114);
  net.setInput(cv::dnn::blobFromImage(place.canvas, 1 / 255.0, {}, {}, true));
  std::vector<cv::Mat> outputs;
  net.forward(outputs, std::vector<std::string>{"output0", "output1"});
  const plain::Table table{outputs[0].ptr<float>(), outputs[0].size[1], outputs[0].size[2]};
  const auto wanted =
      plain::withoutOverlaps(plain::yolov8(table, outputs[1].size[1], kMinScore), kMaxOverlap);
  const auto found = detector->detect({bgr, mrpt::img::SHALLOW_COPY});
  expectSame(found, wanted, place, bgr.size());
  EXPECT_GT(compared_, 3u);
  for (const auto& box : wanted)
  {
    const DetectedObject* object = matching(found, box, place, bgr.size());
    if (!object || !object->mask) continue;
    std::size_t pixels = 0, different = 0, outside = 0;
    for (int y = 0; y < bgr.rows; ++y)
      for (int x = 0; x < bgr.cols; ++x)
      {
        const bool isInBox = x >= object->box.x1 && x <= object->box.x2 && y >= object->box.y1 &&
                             y <= object->box.y2;
        const bool is = object->mask->contains(unsigned(x), unsigned(y));
        if (!isInBox && is) ++outside;
        if (!isInBox) continue;
        ++pixels;
        different += is != (plain::maskSum(outputs[1], box, place, x, y) > 0) ? 1 : 0;
      }
    EXPECT_EQ(outside, 0u) << object->label;
    RecordProperty(object->label, cv::format("%zu of %zu", different, pixels));
    EXPECT_LE(double(different), 0.001 * double(pixels)) << object->label;
  }
}
