#include "quadmap/detection/Detector.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>

#include "OnnxFile.h"
#include "TinyDetector.h"
#include "quadmap/base/Sha256.h"

using namespace quadmap;

namespace
{
mrpt::img::CImage imageOf(const cv::Mat& image) { return {image, mrpt::img::DEEP_COPY}; }

/** Why a model cannot be loaded. */
std::string loadingError(const std::string& model)
{
  try
  {
    loadDetector(model);
  }
  catch (const std::exception& e)
  {
    return e.what();
  }
  return "no error";
}

bool has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}
}  // namespace

TEST(Detector, FindsWhatIsInTheImage)
{
  const TinyDetector tiny;
  const auto detector = loadDetector(tiny.model());
  cv::Mat image(240, 320, CV_8UC3, cv::Scalar(40, 60, 40));
  EXPECT_TRUE(detector->detect(imageOf(image)).empty());
  // One square of the network's input is 40 x 30 pixels of the image.
  image(cv::Rect(80, 90, 40, 30)).setTo(cv::Scalar(0, 0, 255));
  const auto found = detector->detect(imageOf(image));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].label, "chair");
  EXPECT_GT(found[0].score, 0.99);
  EXPECT_LE(found[0].score, 1);
  EXPECT_NEAR(found[0].box.x1, 60, 0.1);
  EXPECT_NEAR(found[0].box.x2, 140, 0.1);
  EXPECT_NEAR(found[0].box.y1, 75, 0.1);
  EXPECT_NEAR(found[0].box.y2, 135, 0.1);
  EXPECT_FALSE(found[0].mask);
}

TEST(Detector, CutsBoxesAtTheBordersOfTheImage)
{
  const TinyDetector tiny;
  const auto detector = loadDetector(tiny.model());
  cv::Mat image(64, 64, CV_8UC3, cv::Scalar::all(0));
  image(cv::Rect(56, 0, 8, 8)).setTo(cv::Scalar(0, 0, 255));
  const auto found = detector->detect(imageOf(image));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].box.x1, 52, 0.1);
  EXPECT_EQ(found[0].box.y1, 0);
  EXPECT_EQ(found[0].box.x2, 63);
}

TEST(Detector, ReadsGreyImages)
{
  const TinyDetector tiny;
  const auto detector = loadDetector(tiny.model());
  EXPECT_TRUE(detector->detect(imageOf(cv::Mat(64, 64, CV_8UC1, cv::Scalar(200)))).empty());
  EXPECT_THROW(detector->detect(mrpt::img::CImage()), std::exception);
}

TEST(Detector, TellsWhatItIs)
{
  const TinyDetector tiny;
  EXPECT_EQ(loadDetector(tiny.model())->description(), "tiny (darknet, 2 labels, input 64x64)");
}

TEST(Detector, TheSameImageGivesTheSameWithAnyNumberOfThreads)
{
  const TinyDetector tiny;
  cv::Mat image(480, 640, CV_8UC3);
  cv::randu(image, 0, 255);
  image(cv::Rect(80, 90, 200, 130)).setTo(cv::Scalar(0, 0, 255));
  const auto boxes = [&](int threads)
  {
    cv::setNumThreads(threads);
    const auto found = loadDetector(tiny.model())->detect(imageOf(image));
    cv::setNumThreads(-1);
    std::vector<double> numbers;
    for (const auto& o : found)
      for (const double x : {o.score, o.box.x1, o.box.y1, o.box.x2, o.box.y2}) numbers.push_back(x);
    return numbers;
  };
  const auto one = boxes(1);
  EXPECT_GT(one.size(), 5u);
  EXPECT_EQ(boxes(2), one);
}

TEST(Detector, IsRefusedWithTheFileThatIsWrong)
{
  const TinyDetector tiny;
  const auto& folder = tiny.folder;
  const std::string weights = folder.path("tiny.weights"), whole = readFile(weights);
  EXPECT_EQ(loadingError(tiny.model()), "no error");

  folder.write("tiny.weights", whole.substr(0, whole.size() - 4));
  EXPECT_EQ(
      loadingError(tiny.model()),
      weights + ": has 5420 bytes, but " + folder.path("tiny.cfg") + " takes 5424");
  folder.write("tiny.weights", "");
  EXPECT_EQ(loadingError(tiny.model()), weights + ": is empty");
  std::filesystem::remove(weights);
  EXPECT_TRUE(
      has(loadingError(tiny.model()), "its file tiny.weights is neither beside it nor in "));
  folder.write("tiny.weights", whole);

  folder.write("tiny.names", "chair\n\ncup\nbook\n");
  EXPECT_EQ(
      loadingError(tiny.model()),
      weights + ": its outputs (64x7) have 2 classes, but there are 3 labels (" +
          folder.path("tiny.names") + ")");
  folder.write("tiny.names", "chair\ncup\n");
  folder.write("tiny.cfg", "[net]\nnonsense\n");
  EXPECT_TRUE(has(
      loadingError(tiny.model()), weights +
                                      ": is damaged, or of a kind that OpenCV cannot load with " +
                                      folder.path("tiny.cfg") + " ("));
}

TEST(Detector, IsRefusedInPlainWordsWhenAPartOfItIsMissing)
{
  const TemporaryFolder folder;
  folder.write("m.names", "chair\n");
  const std::string model = folder.write(
      "m.ini", "[detector]\nweights = m.onnx\nlabels = m.names\nwidth = 320\nheight = 320\n");
  folder.write("m.onnx", onnx::file({onnx::node("Conv", {"in"}, "out")}, ""));
  const std::string message = loadingError(model);
  EXPECT_EQ(
      message.find(folder.path("m.onnx") + ": is damaged, or of a kind that OpenCV cannot load ("),
      0u)
      << message;
  for (const char* inner : {"OpenCV(", "handleNode", "Assertion", ".cpp"})
    EXPECT_FALSE(has(message, inner)) << message;
}

TEST(Detector, IsRefusedWhenItIsNoNetwork)
{
  const TemporaryFolder folder;
  folder.write("m.ini", "[detector]\nweights = m.onnx\n");
  for (const char* content : {"", "no network", "\x08\x07"})
  {
    folder.write("m.onnx", content);
    const std::string message = loadingError(folder.path("m.ini"));
    EXPECT_EQ(message.find(folder.path("m.onnx") + ": "), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  EXPECT_TRUE(has(loadingError(folder.path("n.ini")), "n.ini: there is no such model file"));
  EXPECT_TRUE(has(loadingError("nosuch"), "nosuch: is no known model"));
  EXPECT_TRUE(has(loadingError("nosuch"), "nanodet-m"));
}

TEST(Detector, SaysThatANetworkNeedsAModelFile)
{
  const TemporaryFolder folder;
  for (const char* name : {"m.onnx", "UP.ONNX", "d.weights", "d.cfg"})
  {
    const std::string network = folder.path(name);
    EXPECT_EQ(loadingError(network), network + ": there is no such file");
    folder.write(name, "no network");
    EXPECT_EQ(
        loadingError(network), network +
                                   ": is a network and needs a model file (.ini) with weights, "
                                   "labels, width and height; see quadmap-detect --help");
  }
  const std::string sub = folder.path("sub.onnx");
  std::filesystem::create_directory(sub);
  EXPECT_EQ(loadingError(sub), sub + ": there is no such file") << "a folder";
  // The lines that it names are a model file, which fails on the network alone.
  folder.write("m.names", "chair\n");
  const std::string network = folder.path("m.onnx"),
                    model = folder.write(
                        "m.ini",
                        "[detector]\nweights = m.onnx\nlabels = m.names\n"
                        "width = 640\nheight = 640\n");
  EXPECT_EQ(loadingError(model).find(network + ": "), 0u) << loadingError(model);
  EXPECT_EQ(
      loadingError(network),
      network + ": is a network and needs a model file; " + model + " is beside it");
}

TEST(Detector, IsRefusedWhenItsChecksumIsAnother)
{
  const TinyDetector tiny;
  const std::string weights = tiny.folder.path("tiny.weights");
  tiny.folder.write("tiny.ini", tiny.ini() + "weightsSha256 = " + sha256OfFile(weights) + "\n");
  EXPECT_EQ(loadingError(tiny.model()), "no error");
  std::string damaged = readFile(weights);
  damaged[100] ^= 1;
  tiny.folder.write("tiny.weights", damaged);
  EXPECT_TRUE(has(loadingError(tiny.model()), weights + ": is damaged or another file"));
}
