#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/dnn.hpp>
#include <string>
#include <vector>

#include "../obs/TestData.h"
#include "quadmap/detection/Detector.h"
#include "quadmap/folders/FolderKinds.h"

// Time of a detector per 640x480 image, on one core, beside that of its network alone in OpenCV.

namespace
{
using namespace quadmap;

constexpr std::size_t kFrames = 20;

/** A network and its input. */
struct Network
{
  const char *model, *file;
  int side;  // [px]
};

std::vector<mrpt::img::CImage> recordedImages()
{
  std::vector<mrpt::img::CImage> images;
  const std::string folder = testData("kitchen_a");
  if (folder.empty()) return images;
  const FrameFolder dataset = openFrameFolder("tum", folder);
  for (std::size_t i = 0; i < kFrames; ++i)
    images.push_back(dataset.scan(i * dataset.frames().size() / kFrames)->intensityImage);
  return images;
}

void countFrames(benchmark::State& state, std::size_t frames)
{
  state.counters["time_per_frame"] = benchmark::Counter(
      static_cast<double>(frames), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void networkAlone(benchmark::State& state, const Network& network)
{
  const std::string file = testData("detector") + "/" + network.file;
  if (!std::filesystem::exists(file)) return state.SkipWithError("network not found");
  cv::setNumThreads(1);
  cv::dnn::Net net = cv::dnn::readNetFromONNX(file);
  net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
  const cv::Mat input = cv::dnn::blobFromImage(
      cv::Mat(network.side, network.side, CV_8UC3, cv::Scalar::all(100)), 1 / 255.0);
  const auto outputs = net.getUnconnectedOutLayersNames();
  std::size_t frames = 0;
  for (auto _ : state)
    for (std::size_t i = 0; i < kFrames; ++i, ++frames)
    {
      std::vector<cv::Mat> result;
      net.setInput(input);
      net.forward(result, outputs);
      benchmark::DoNotOptimize(result);
    }
  countFrames(state, frames);
}

void detector(benchmark::State& state, const Network& network)
{
  const auto images = recordedImages();
  if (images.empty() || testData("detector").empty())
    return state.SkipWithError("recording or network not found");
  ::setenv("QUADMAP_MODELS", testData("detector").c_str(), 1);
  cv::setNumThreads(1);
  const auto detector = loadDetector(network.model);
  std::size_t frames = 0;
  for (auto _ : state)
    for (const auto& image : images)
    {
      benchmark::DoNotOptimize(detector->detect(image));
      ++frames;
    }
  countFrames(state, frames);
}

constexpr Network kNanoDet{"nanodet-m", "nanodet.onnx", 320};
constexpr Network kYolox{"yolox-nano", "yolox_nano.onnx", 416};
constexpr Network kYolov8{"yolov8n", "yolov8n.onnx", 640};

BENCHMARK_CAPTURE(networkAlone, nanodet, kNanoDet)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(detector, nanodet, kNanoDet)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(networkAlone, yolox, kYolox)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(detector, yolox, kYolox)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(networkAlone, yolov8, kYolov8)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(detector, yolov8, kYolov8)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
