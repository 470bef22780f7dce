#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "AllocationWatch.h"
#include "Fuzz.h"
#include "SmallRecording.h"

using namespace quadmap;

namespace
{
constexpr const char* kMatrix = "1 0 0 1.5\n0 1 0 -2\n0 0 1 3e-1\n0 0 0 1\n";

void fuzzRecording(const std::string& name, bool withAssociations = true)
{
  const SmallRecording recording;
  if (!withAssociations) recording.remove("associations.txt");
  FuzzRun run;
  run.place = recording.files().folder().string();
  run.words = {"rows: 999999999", "- ", "!!", "data: [", "&a", "*a", " ", "1e9", "? ", "%YAML"};
  fuzz(recording.text(name), run, [&](const std::string& text) { recording.readWith(name, text); });
}

/** Of files with the numbers of a matrix. */
FuzzRun matrixRun(const TemporaryFolder& folder)
{
  FuzzRun run;
  run.place = folder.folder().string();
  run.words = {" ", "1e300", "1e-300", "-1", "inf", "0x1", "1e9"};
  return run;
}
}  // namespace

TEST(Fuzz, TumCalibration) { fuzzRecording("calibration.yaml"); }
TEST(Fuzz, TumDetections) { fuzzRecording("detections/1.txt"); }
TEST(Fuzz, TumAssociations) { fuzzRecording("associations.txt"); }
TEST(Fuzz, TumGroundTruth) { fuzzRecording("groundtruth.txt"); }
TEST(Fuzz, TumImageLists)
{
  fuzzRecording("rgb.txt", false);
  fuzzRecording("depth.txt", false);
}

namespace
{
/** A recording of 7-Scenes with one frame and no pixels. */
struct SmallSevenScenes
{
  TemporaryFolder files;

  SmallSevenScenes()
  {
    for (const char* name : {"frame-000000.color.png", "frame-000000.depth.png"})
      files.write(name, "");
    files.write("frame-000000.pose.txt", kMatrix);
  }
  void read(const FrameFolderOptions& options = {}) const
  {
    readFrames(openFrameFolder("7scenes", files.folder().string(), options));
  }
};
}  // namespace

TEST(Fuzz, SevenScenesPose)
{
  const SmallSevenScenes scene;
  fuzz(
      kMatrix, matrixRun(scene.files),
      [&](const std::string& text)
      {
        scene.files.write("frame-000000.pose.txt", text);
        scene.read();
      });
}

TEST(Fuzz, CameraFile)
{
  const SmallSevenScenes scene;
  FuzzRun run;
  run.place = "camera.ini";
  run.words = {"[camera]", "[]", "=", "depthWidth = 4", "k1 = 0.1", "fy = -9", "${", "1e6", "\\\n"};
  FrameFolderOptions options;
  options.camera = scene.files.path("camera.ini");
  fuzz(
      "# comment\n[camera]\nfolders = a b\nwidth = 8\nheight = 6\nfx = 9.5\nfy = 9.25\ncx = 3.5\n"
      "k1 = 0.01\nk3 = -0.1\ndepthFactor = 1000\nnoDepth = 65535\ndepthWidth = 4\n"
      "depthHeight = 3\ndepthFx = 5\ndepthFy = 5\ndepthCy = 1.25\n"
      "T_color_depth = 1 0 0 0.02 0 1 0 0 0 0 1 0\nposesAreOfDepth = yes\nworldUp = 0 -1 0.1\n",
      run,
      [&](const std::string& text)
      {
        scene.files.write("camera.ini", text);
        scene.read(options);
      });
}

namespace
{
/** A scene of ScanNet with one frame of few pixels. */
class SmallScanNet
{
 public:
  SmallScanNet()
  {
    for (const char* sub : {"color", "depth", "pose", "intrinsic"})
      std::filesystem::create_directory(files_.path(sub));
    cv::imwrite(files_.path("color/0.jpg"), cv::Mat(6, 8, CV_8UC3, cv::Scalar(40, 80, 120)));
    cv::imwrite(files_.path("depth/0.png"), cv::Mat(3, 4, CV_16UC1, cv::Scalar(1500)));
    for (const auto& [name, text] : texts_) files_.write(name, text);
  }

  const TemporaryFolder& files() const { return files_; }

  void fuzzTexts() const
  {
    for (const auto& [name, text] : texts_)
    {
      fuzz(
          text, matrixRun(files_),
          [&, file = name](const std::string& damaged)
          {
            files_.write(file, damaged);
            readFrames(open());
          });
      files_.write(name, text);
    }
  }

  /** Damages an image, which is read as an import reads it. */
  void fuzzImage(const std::string& name) const
  {
    FuzzRun run;
    run.place = files_.folder().string();
    run.words = {"IHDR", "IDAT", "PLTE", "tRNS", "eXIf", "\xff\xc0", "\xff\xc4", "\xff\xda"};
    fuzz(
        readFile(files_.path(name)), run,
        [&](const std::string& bytes)
        {
          files_.write(name, bytes);
          open().recorded(0);
        });
  }

 private:
  FrameFolder open() const { return openFrameFolder("scannet", files_.folder().string()); }

  TemporaryFolder files_;
  const std::map<std::string, std::string> texts_ = {
      {                   "pose/0.txt",                                    kMatrix},
      {"intrinsic/intrinsic_color.txt", "9 0 3.5 0\n0 9 2.5 0\n0 0 1 0\n0 0 0 1\n"},
      {"intrinsic/intrinsic_depth.txt", "4 0 1.5 0\n0 4 1.0 0\n0 0 1 0\n0 0 0 1\n"},
      {"intrinsic/extrinsic_color.txt",                                    kMatrix},
      {"intrinsic/extrinsic_depth.txt",                                    kMatrix},
  };
};
}  // namespace

TEST(Fuzz, ScanNetMatrices) { SmallScanNet().fuzzTexts(); }
TEST(Fuzz, ColourImage) { SmallScanNet().fuzzImage("color/0.jpg"); }
TEST(Fuzz, DepthImage) { SmallScanNet().fuzzImage("depth/0.png"); }

namespace
{
constexpr int kColumns = 12, kRows = 10;  // enough points to tell a camera

std::string pcdHeader(const std::string& data)
{
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z n rgb\nSIZE 4 4 4 1 4\nTYPE F F F U U\n"
         "COUNT 1 1 1 2 1\nWIDTH 12\nHEIGHT 10\nVIEWPOINT 0 0 1 1 0 0 0\nPOINTS 120\nDATA " +
         data + "\n";
}

/** Packs bytes for a compressed cloud: runs of themselves, and copies of what repeats. */
std::string packedLzf(const std::string& plain)
{
  constexpr std::size_t kLongestRun = 32, kLongestCopy = 8;
  std::string out;
  for (std::size_t at = 0; at < plain.size();)
  {
    std::size_t same = 0;
    while (at > 0 && same < kLongestCopy && at + same < plain.size() &&
           plain[at + same] == plain[at - 1])
      ++same;
    if (same > 2)
    {
      out += static_cast<char>((same - 2) << 5);
      out += '\0';  // from one byte back
      at += same;
      continue;
    }
    const std::size_t run = std::min(kLongestRun, plain.size() - at);
    out += static_cast<char>(run - 1);
    out += plain.substr(at, run);
    at += run;
  }
  return out;
}

/** The points of a wall, as what follows the header. */
std::string pcdPoints(const std::string& data)
{
  std::string text, points, fields[5];
  for (int v = 0; v < kRows; ++v)
    for (int u = 0; u < kColumns; ++u)
    {
      const float x = static_cast<float>(u - 6) / 8, y = static_cast<float>(v - 5) / 8, z = 1;
      text += std::to_string(x).substr(0, 6) + " " + std::to_string(y).substr(0, 6) + " 1 7 7 9\n";
      const float numbers[] = {x, y, z};
      std::string values[5] = {{}, {}, {}, "nn", "rgb."};
      for (int i = 0; i < 3; ++i)
        values[i].assign(reinterpret_cast<const char*>(&numbers[i]), sizeof(float));
      for (int i = 0; i < 5; ++i) fields[i] += values[i];
      for (const auto& value : values) points += value;
    }
  if (data == "ascii") return text;
  if (data == "binary") return points;
  const std::string plain = fields[0] + fields[1] + fields[2] + fields[3] + fields[4],
                    packed = packedLzf(plain);
  const auto sizes = {packed.size(), plain.size()};
  std::string out;
  for (const auto size : sizes)
    for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(size >> shift);
  return out + packed;
}

/** Damages a header before good points, where most of what can go wrong is, and whole files. */
void fuzzPcd(const std::string& data)
{
  const TemporaryFolder folder;
  FuzzRun run;
  run.count = 300;
  run.place = "a.pcd";
  run.words = {"FIELDS ", "SIZE 8\n", "COUNT 4096\n",  "WIDTH 4096\n", "HEIGHT 4096\n",
               "TYPE U",  "rgba",     "DATA binary\n", " 99",          "DATA binary_compressed\n"};
  const auto read = [&](const std::string& bytes)
  {
    folder.write("a.pcd", bytes);
    const FrameFolder clouds = openFrameFolder("pcd", folder.folder().string());
    readFrames(clouds);
    clouds.scan(0);
  };
  const std::string header = pcdHeader(data), points = pcdPoints(data);
  fuzz(header, run, [&](const std::string& damaged) { read(damaged + points); });
  run.mostlyHarmless = true;  // most bytes are of points, one of which may be anywhere
  fuzz(header + points, run, read);
}
}  // namespace

TEST(Fuzz, PcdThatStatesMoreThanItHas)
{
  const TemporaryFolder folder;
  std::string fields = "FIELDS";
  for (int i = 0; i < 200000; ++i) fields += " n";
  // 12 bytes that say that they are 3, and 240 MB when they are unpacked
  const std::string points = {'\3', '\0', '\0', '\0', '\0', '\0', '\0', '\xf', '\1', 'a', 'b', 'c'};
  const std::string large =
      "FIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\n"
      "WIDTH 4096\nHEIGHT 3840\nDATA ";
  for (const auto& text :
       {fields + "\n", large + "ascii\n1 2 3", large + "binary\n1",
        large + "binary_compressed\n" + points})
  {
    folder.write("a.pcd", text);
    AllocationWatch::reset();
    const auto error = errorOf([&] { openFrameFolder("pcd", folder.folder().string()); });
    EXPECT_NE(error.find("a.pcd: "), std::string::npos) << error;
    EXPECT_LT(AllocationWatch::largest(), std::size_t{1} << 22) << error;
  }
}

TEST(Fuzz, PcdText) { fuzzPcd("ascii"); }
TEST(Fuzz, PcdBinary) { fuzzPcd("binary"); }
TEST(Fuzz, PcdCompressed) { fuzzPcd("binary_compressed"); }
