#include "DnnDetector.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "ObjectMasks.h"
#include "Suppression.h"
#include "model/ModelFolder.h"
#include "model/OnnxTensors.h"
#include "quadmap/base/ErrorText.h"
#include "quadmap/base/StderrCapture.h"
#include "quadmap/folders/ClassNames.h"
#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/sensors/MemoryGuard.h"

namespace quadmap
{
namespace
{
/** Bytes before the numbers in a file of Darknet: three of 4 bytes, of which the first two are the
 * version, and the number of images seen in training, which is longer since version 0.2. */
std::uintmax_t headerBytes(const std::string& weights)
{
  std::int32_t version[2] = {0, 0};
  std::ifstream(weights, std::ios::binary).read(reinterpret_cast<char*>(version), sizeof version);
  return 3 * 4 + (version[0] * 10 + version[1] >= 2 ? 8 : 4);
}

/** OpenCV takes whatever is in memory for the numbers that a short file of Darknet lacks.
 * \exception std::runtime_error If the file has not as many numbers as the network takes. */
void requireAllWeights(cv::dnn::Net& net, const ModelFiles& files)
{
  std::uintmax_t numbers = 0;
  for (const std::string& name : net.getLayerNames())
  {
    const auto layer = net.getLayer(net.getLayerId(name));
    if (layer->type == "Region") continue;  // its anchors are in the plan
    for (const cv::Mat& blob : layer->blobs) numbers += blob.total();
  }
  const auto expected = headerBytes(files.weights) + 4 * numbers;
  const auto bytes = std::filesystem::file_size(files.weights);
  if (bytes != expected)
    throw std::runtime_error(
        mrpt::format("has %ju bytes, but %s takes %ju", bytes, files.network.c_str(), expected));
}

/** Most memory that loading a network may take, and as much again its first run [bytes]. Networks
 * take some copies of their weights, and less than a hundred numbers for each pixel of the input.
 * But a few bytes of a file can state a tensor of any size. */
std::uint64_t mostMemory(const DetectorModel& model, const ModelFiles& files)
{
  constexpr std::uint64_t kAlways = std::uint64_t{1} << 28, kCopies = 4, kPerPixel = 400;
  const auto pixels =
      static_cast<std::uint64_t>(model.width) * static_cast<std::uint64_t>(model.height);
  return kAlways + kCopies * std::filesystem::file_size(files.weights) + kPerPixel * pixels;
}

cv::dnn::Net loadNet(const DetectorModel& model, const ModelFiles& files)
{
  try
  {
    if (std::filesystem::file_size(files.weights) == 0) throw std::runtime_error("is empty");
    const StderrCapture capture;  // OpenCV also prints what it throws
    const MemoryGuard guard(mostMemory(model, files));
    if (files.network.empty())
    {
      requireAllNumbers(files.weights);
      return cv::dnn::readNetFromONNX(files.weights);
    }
    cv::dnn::Net net = cv::dnn::readNetFromDarknet(files.network, files.weights);
    requireAllWeights(net, files);
    return net;
  }
  catch (const cv::Exception& e)
  {
    const std::string with = files.network.empty() ? "" : " with " + files.network;
    throw std::runtime_error(
        files.weights + ": is damaged, or of a kind that OpenCV cannot load" + with + " (" +
        rootMessage(e) + ")");
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error(files.weights + ": " + rootMessage(e));
  }
}

InputBlob::Format formatOf(const DetectorModel& model)
{
  return {
      {model.width, model.height},
      model.fit,
      model.padding,
      model.channels,
      model.mean,
      model.deviation
  };
}

/** Three channels of 8 bits. */
cv::Mat bgrOf(const cv::Mat& image)
{
  cv::Mat bgr = image;
  if (bgr.depth() == CV_16U) image.convertTo(bgr, CV_8U, 1 / 256.0);
  if (bgr.channels() == 1) cv::cvtColor(bgr, bgr, cv::COLOR_GRAY2BGR);
  if (bgr.empty() || bgr.type() != CV_8UC3)
    throw std::runtime_error("its colour image has a format that no detector reads");
  return bgr;
}

}  // namespace

DnnDetector::DnnDetector(const DetectorModel& model, const ModelFiles& files) :
    model_(model),
    files_(files),
    labels_(readClassNames(files.labels)),
    net_(loadNet(model, files)),
    outputNames_(net_.getUnconnectedOutLayersNames()),
    input_(formatOf(model))
{
  net_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
  input_.fill(cv::Mat::zeros(model.height, model.width, CV_8UC3));
  HeadRequest request;
  request.kind = model.isDarknet() ? HeadKind::Darknet : model.head;
  request.width = model.width;
  request.height = model.height;
  request.labels = labels_.size();
  {
    const StderrCapture capture;
    const MemoryGuard guard(mostMemory(model, files));
    for (const Tensor& output : run()) request.shapes.push_back(output.shape);
  }
  try
  {
    std::tie(kind_, head_) = chooseHead(request);
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error(files.weights + ": " + e.what() + " (" + files.labels + ")");
  }
}

std::vector<Tensor> DnnDetector::run()
try
{
  net_.setInput(input_.blob());
  net_.forward(outputs_, outputNames_);
  std::vector<Tensor> tensors;
  for (const cv::Mat& output : outputs_)
  {
    if (output.type() != CV_32F || !output.isContinuous())
      throw std::runtime_error("its outputs are not numbers of 32 bits");
    const Shape shape(output.size.p, output.size.p + output.dims);
    tensors.push_back({withoutBatch(shape), output.ptr<float>()});
  }
  return tensors;
}
catch (const cv::Exception& e)
{
  throw std::runtime_error(
      files_.weights + ": OpenCV cannot run it on an input of " + std::to_string(model_.width) +
      "x" + std::to_string(model_.height) + ": " + rootMessage(e));
}

std::vector<DetectedObject> DnnDetector::detect(const mrpt::img::CImage& image)
{
  const cv::Mat bgr = bgrOf(image.asCvMatRef());
  const Placement place = input_.fill(bgr);
  const std::vector<Tensor> outputs = run();
  const auto rawBoxes = suppressOverlaps(
      head_->rawBoxes(outputs, static_cast<float>(model_.minScore)), model_.maxOverlap,
      CObservationObjects::kMostObjects);
  std::vector<DetectedObject> objects;
  for (const RawBox& rawBox : rawBoxes)
  {
    const ImageBox box =
        place.toImage(rawBox.box)
            .clipped(static_cast<unsigned>(bgr.cols), static_cast<unsigned>(bgr.rows));
    if (box.isValid()) objects.push_back(objectOf(rawBox, box, place, outputs));
  }
  return objects;
}

DetectedObject DnnDetector::objectOf(
    const RawBox& rawBox,
    const ImageBox& box,
    const Placement& place,
    const std::vector<Tensor>& outputs) const
{
  DetectedObject object;
  object.label = labels_[rawBox.label];
  object.score = std::min(1.0, static_cast<double>(rawBox.score));
  object.box = box;
  const int masks = head_->maskOutput();
  if (masks >= 0)
    object.mask = objectMask(
        outputs[static_cast<std::size_t>(masks)], rawBox, box, place,
        {model_.width, model_.height});
  return object;
}

std::string DnnDetector::description() const
{
  return mrpt::format(
      "%s (%s%s, %zu labels, input %dx%d)", files_.name.c_str(), nameOf(kind_),
      head_->maskOutput() >= 0 ? " with masks" : "", labels_.size(), model_.width, model_.height);
}

}  // namespace quadmap
