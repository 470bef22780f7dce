#include "model/OnnxTensors.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "../obs/TemporaryFolder.h"
#include "KitchenModels.h"
#include "OnnxFile.h"
#include "quadmap/detection/Detector.h"

using namespace quadmap;

namespace
{
/** What is wrong with the tensors of a file. */
std::string errorIn(const std::string& onnxFile)
{
  const TemporaryFolder folder;
  const auto file = folder.write("m.onnx", onnxFile);
  return errorOf([&] { requireAllNumbers(file); });
}

std::string errorInTensor(const std::string& tensor)
{
  const auto added = onnx::node("Add", {"in", "w"}, "out");
  const auto first = errorIn(onnx::file({added}, tensor));
  // The same as the value of a node, and of a node in a graph of a node.
  const auto constant = onnx::node("Constant", {}, "w", onnx::text(5, tensor));
  EXPECT_EQ(errorIn(onnx::file({constant, added}, "")), first);
  const auto inner = onnx::text(6, onnx::text(1, constant));
  EXPECT_EQ(errorIn(onnx::file({onnx::node("If", {}, "w", inner), added}, "")), first);
  return first;
}

/** Loading a network as a detector. \return Why that fails. */
std::string detectorError(const std::string& onnxFile)
{
  const TemporaryFolder folder;
  folder.write("m.onnx", onnxFile);
  folder.write("m.names", "chair\ncup\n");
  const auto model = folder.write(
      "m.ini", "[detector]\nweights = m.onnx\nlabels = m.names\nwidth = 320\nheight = 320\n");
  const auto error = errorOf([&] { loadDetector(model); });
  EXPECT_EQ(error.find(folder.path("m.onnx") + ": "), 0u) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  return error;
}

/** The most memory that the process ever had [MB]. */
long mostMemory()
{
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss >> 10;
}

constexpr std::uint64_t kMany = std::uint64_t{1} << 28;
}  // namespace

TEST(OnnxTensors, HoldWhatTheyState)
{
  const std::string sixteen(16, '\0');
  for (const auto& right :
       {onnx::tensor({4}, onnx::kFloat, sixteen), onnx::tensor({2, 2}, onnx::kFloat, sixteen),
        onnx::tensor({2}, onnx::kInt64, sixteen), onnx::tensor({}, onnx::kFloat, "abcd"),
        onnx::tensor({4}, onnx::kFloat, sixteen, 4),
        onnx::tensor({2}, onnx::kInt64, onnx::integer(300) + onnx::integer(5), 7),
        onnx::tensor({0}, onnx::kFloat, ""), onnx::tensor({kMany}, onnx::kFloat, "")})
    EXPECT_EQ(errorInTensor(right), "");
  EXPECT_EQ(
      errorInTensor(onnx::tensor({kMany}, onnx::kFloat, sixteen)),
      "its tensor 'w' states 268435456 numbers and holds 16 bytes");
  // Protocol Buffers ignore what is written as a number of 8 bytes where floats should be.
  const std::string eightBytesAsFloats = onnx::integer(4 << 3 | 1) + std::string(8, '\0');
  for (const auto& wrong :
       {onnx::tensor({5}, onnx::kFloat, sixteen), onnx::tensor({3}, onnx::kFloat, sixteen),
        onnx::tensor({5}, onnx::kFloat, sixteen, 4), onnx::tensor({3}, onnx::kInt64, sixteen),
        onnx::tensor({65536, 65536}, onnx::kFloat, sixteen),
        onnx::tensor({std::uint64_t{1} << 62, 4, 4}, onnx::kFloat, sixteen),
        onnx::tensor({~std::uint64_t{0}, 4}, onnx::kFloat, sixteen),
        onnx::tensor({4}, onnx::kFloat, sixteen, 5),  // numbers of another type
        onnx::tensor({4}, 99, sixteen),
        onnx::tensor({4}, onnx::kFloat, sixteen) + onnx::text(4, "1234"),
        onnx::tensor({1}, onnx::kFloat, "1234", 4) + onnx::number(1, 3) + eightBytesAsFloats})
    EXPECT_NE(errorInTensor(wrong).find("its tensor 'w' "), std::string::npos);
}

TEST(OnnxTensors, AreNotPutTogetherFromSeveral)
{
  const auto half = onnx::text(5, onnx::tensor({2}, onnx::kFloat, std::string(8, '\0')));
  const auto node = onnx::node("Constant", {}, "w", half + half);
  EXPECT_EQ(errorIn(onnx::file({node}, "")), "an attribute has two tensors");
}

TEST(OnnxTensors, OfDamagedFilesAreRefused)
{
  const auto whole = onnx::file(
      {onnx::node("Add", {"in", "w"}, "out")},
      onnx::tensor({4}, onnx::kFloat, std::string(16, '\0')));
  EXPECT_EQ(errorIn(whole), "");
  for (std::size_t size = 3; size + 20 < whole.size(); size += 7)
    EXPECT_EQ(errorIn(whole.substr(0, size)), "is damaged, or no network in ONNX") << size;
  std::string graph = onnx::text(1, "");
  for (int i = 0; i < 20; ++i) graph = onnx::text(1, onnx::text(5, onnx::text(6, graph)));
  EXPECT_NE(errorIn(onnx::text(7, graph)).find("too deeply"), std::string::npos);
}

TEST(OnnxTensors, ThatAreShortAreNotGivenToOpenCv)  // it reads behind their end
{
  const auto error = detectorError(onnx::file(
      {onnx::node("Add", {"in", "w"}, "out")},
      onnx::tensor({kMany}, onnx::kFloat, std::string(16, '\0'))));
  EXPECT_NE(error.find("holds 16 bytes"), std::string::npos) << error;
}

TEST(OnnxTensors, OfAnySizeTakeLittleMemory)
{
#ifdef QUADMAP_SANITIZED
  GTEST_SKIP() << "sanitizers end the program when memory is refused";
#endif
  const auto constant = onnx::file(
      {onnx::node("ConstantOfShape", {"w"}, "c"), onnx::node("Add", {"in", "c"}, "out")},
      onnx::tensor({2}, onnx::kInt64, onnx::rawIntegers({1 << 20, 1 << 12})));
  const auto expanded = onnx::file(
      {onnx::node("Expand", {"in", "w"}, "out")},
      onnx::tensor({4}, onnx::kInt64, onnx::rawIntegers({1 << 10, 3, 320, 320})));
  for (const auto& network : {constant, expanded})
  {
    const auto error = detectorError(network);
    EXPECT_NE(error.find("allocate"), std::string::npos) << error;
  }
  EXPECT_LT(mostMemory(), 1000);
}

class RealTensors : public KitchenModels
{
};

TEST_F(RealTensors, HoldWhatTheyState)
{
  for (const char* name : {"nanodet.onnx", "yolov8n.onnx", "yolox_nano.onnx"})
    EXPECT_EQ(errorOf([&] { requireAllNumbers(models_ + "/" + name); }), "") << name;
}
