#include "model/DetectorModel.h"

#include <mrpt/config/CConfigFile.h>

#include <stdexcept>

#include "quadmap/base/ConfigCheck.h"
#include "quadmap/base/OptionList.h"

namespace quadmap
{
namespace
{
constexpr const char* kSection = "detector";

constexpr std::pair<HeadKind, const char*> kHeads[] = {
    {   HeadKind::Auto,    "auto"},
    {HeadKind::Darknet, "darknet"},
    {HeadKind::NanoDet, "nanodet"},
    {  HeadKind::Yolox,   "yolox"},
    { HeadKind::Yolov5,  "yolov5"},
    { HeadKind::Yolov8,  "yolov8"},
};
constexpr std::pair<Fit, const char*> kFits[] = {
    { Fit::Centre,  "centre"},
    {Fit::TopLeft, "topleft"},
    {Fit::Stretch, "stretch"}
};
constexpr std::pair<ChannelOrder, const char*> kOrders[] = {
    {ChannelOrder::Rgb, "rgb"},
    {ChannelOrder::Bgr, "bgr"}
};

bool isSha256(const std::string& text)
{
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

void addText(OptionList& list, const char* key, std::string& field, const char* reason)
{
  list.text(
      key, [&field] { return field; }, [&field](const std::string& text) { field = text; },
      "any text", reason);
}

void addSum(OptionList& list, const char* key, std::string& field, const char* reason)
{
  list.text(
      key, [&field] { return field; },
      [&field, key](const std::string& text)
      {
        if (!text.empty() && !isSha256(text))
          throw std::invalid_argument(
              std::string(key) + "=" + text + ": must be 64 digits 0-9, a-f");
        field = text;
      },
      "64 hexadecimal digits", reason);
}

}  // namespace

const char* nameOf(HeadKind kind)
{
  for (const auto& [known, name] : kHeads)
    if (known == kind) return name;
  return "";
}

void DetectorModel::describe(OptionList& list)
{
  list.about("One object detector: its files, how an image is given to it, how it is read.");
  addText(list, "weights", weights.file, "The network, .onnx, or the .weights of Darknet.");
  addText(list, "weightsUrl", weights.url, "Where to get the weights.");
  addSum(list, "weightsSha256", weights.sha256, "Checksum; other weights are refused.");
  addText(list, "network", network.file, "The .cfg of a Darknet network; none for .onnx.");
  addText(list, "networkUrl", network.url, "Where to get the .cfg.");
  addSum(list, "networkSha256", network.sha256, "Checksum of the .cfg; another one is refused.");
  addText(list, "labels", labels, "File with the names of the classes, one a line.");
  list.choice(
      "head", head, kHeads,
      "What the outputs mean. auto tells it from their shapes; yolov8 is YOLO11's, too.");
  list.integer("width", width, {32, 4096}, "px", "Of the network's input.");
  list.integer("height", height, {32, 4096}, "px", "Of the network's input.");
  list.choice(
      "fit", fit, kFits,
      "How an image is brought to the size of the input: with its proportions, in the centre or at "
      "the upper left with padding around, or stretched.");
  list.number("padding", padding, {0, 255}, "", "Value of all channels around the image.");
  list.choice("channels", channels, kOrders, "The order of the network's channels.");
  list.vector(
      "mean", mean.data(), {-1e6, 1e6}, "", "Subtracted from the channels, in their order.");
  list.vector(
      "deviation", deviation.data(), {1e-6, 1e6}, "",
      "The channels are divided by it after the mean is subtracted.");
  list.number(
      "minScore", minScore, {0.001, 1}, "",
      "Boxes with less are left out. OpenCV drops those of Darknet below 0.2 in any case.");
  list.number(
      "maxOverlap", maxOverlap, {0, 1}, "",
      "Of two boxes of a label with a greater intersection over union the surer one stays.");
  addText(list, "licence", licence, "Of the weights.");
  list.require(
      [this] { return !isDarknet() || head == HeadKind::Auto || head == HeadKind::Darknet; },
      "head must be darknet or auto when there is a network of Darknet");
}

DetectorModel DetectorModel::fromFile(const std::string& path)
{
  requireReadableIni(path);
  DetectorModel model;
  try
  {
    const mrpt::config::CConfigFile config(path);
    rejectUnknownSections(config, "", {kSection});
    model.loadFromConfigFile(config, kSection);
    if (model.weights.file.empty()) throw std::invalid_argument("[detector] weights is missing");
  }
  catch (const std::invalid_argument& e)
  {
    throw std::invalid_argument(path + ": " + e.what());
  }
  return model;
}

std::vector<ModelPart> DetectorModel::parts() const
{
  if (isDarknet()) return {network, weights};
  return {weights};
}

}  // namespace quadmap
