#include <gtest/gtest.h>
#include <mrpt/core/format.h>

#include <Eigen/Dense>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "../../obs/TemporaryFolder.h"
#include "quadmap/folders/FolderKinds.h"

using namespace quadmap;

namespace
{
constexpr double kBegin = 1305031100.0;  // [s]

/** A recording as the TUM RGB-D benchmark offers it: images at 30 Hz with depth 12 ms after colour,
 * poses at 100 Hz that begin later, and the accelerometer. The camera moves along x at 0.5 m/s. */
class TumDownload : public ::testing::Test
{
 protected:
  static constexpr int kImages = 6;

  explicit TumDownload(const std::string& name = "rgbd_dataset_freiburg1_xyz") :
      folder_(files_.path(name))
  {
    namespace fs = std::filesystem;
    fs::create_directories(folder_ + "/rgb");
    fs::create_directories(folder_ + "/depth");
    std::string colors = "# color images\n# file: 'x.bag'\n# timestamp filename\n", depths = colors;
    for (int i = 0; i < kImages; ++i)
    {
      const std::string color = mrpt::format("rgb/%.6f.png", colorTime(i)),
                        depth = mrpt::format("depth/%.6f.png", depthTime(i));
      cv::imwrite(folder_ + "/" + color, cv::Mat(480, 640, CV_8UC3, cv::Scalar(10, 20, 30)));
      cv::imwrite(folder_ + "/" + depth, cv::Mat(480, 640, CV_16UC1, cv::Scalar(7500)));
      colors += mrpt::format("%.6f %s\n", colorTime(i), color.c_str());
      if (i != 3) depths += mrpt::format("%.6f %s\n", depthTime(i), depth.c_str());
    }
    std::string poses = "# ground truth trajectory\n";
    for (double t = kBegin + 0.05; t < kBegin + 0.3; t += 0.01)
      poses += mrpt::format("%.4f %.5f 1 2 0 0 0 1\n", t, 0.5 * (t - kBegin));
    write("rgb.txt", colors);
    write("depth.txt", depths);
    write("groundtruth.txt", poses);
    write("accelerometer.txt", "# timestamp ax ay az\n1305031100.1 0.1 9.8 0.2\n");
  }

  void write(const std::string& name, const std::string& text) const
  {
    files_.write(std::filesystem::path(folder_).filename().string() + "/" + name, text);
  }
  static double colorTime(int i) { return kBegin + i / 30.0; }
  static double depthTime(int i) { return colorTime(i) + 0.012; }

  TemporaryFolder files_;
  std::string folder_;
};

class TumDownloadOfOtherName : public TumDownload
{
 protected:
  TumDownloadOfOtherName() : TumDownload("desk") {}
};
}  // namespace

TEST_F(TumDownload, IsReadAsItIs)
{
  EXPECT_EQ(kindOfFolder(folder_), "tum");
  const FrameFolder folder = openFrameFolder("tum", folder_);
  EXPECT_EQ(folder.camera().origin, "camera fr1");
  ASSERT_EQ(folder.frames().size(), 5u);
  EXPECT_EQ(folder.unpaired(), 1u) << "the colour image whose depth image is missing";
  EXPECT_NEAR(folder.frames()[3].time, depthTime(4), 1e-6) << "the time of the depth image";
  EXPECT_EQ(folder.pairing(), "by time, at most 20 ms apart");
  const auto scan = folder.scan(0);
  EXPECT_NEAR(scan->cameraParams.fx(), 517.3, 1e-9);
  EXPECT_FLOAT_EQ(static_cast<float>(scan->rangeImage(240, 320)) * scan->rangeUnits, 1.5f);
}

TEST_F(TumDownload, TakesPosesBetweenThoseOfTheTruth)
{
  const FrameFolder folder = openFrameFolder("tum", folder_);
  EXPECT_FALSE(folder.T_world_robot(0)) << "before the first pose";
  EXPECT_FALSE(folder.T_world_robot(1)) << "before the first pose";
  EXPECT_EQ(folder.posesCount(), 3u);
  ASSERT_TRUE(folder.T_world_robot(2));
  EXPECT_NEAR(folder.T_world_robot(2)->x(), 0.5 * (depthTime(2) - kBegin), 1e-5);
  EXPECT_NEAR(folder.T_world_robot(2)->z(), 2, 1e-9) << "the benchmark's z is up";
}

TEST_F(TumDownload, RefusesManyImagesOfOneTime)
{
  std::string depths;
  for (int i = 0; i < 101; ++i) depths += mrpt::format("%.6f depth/%d.png\n", depthTime(1), i);
  write("depth.txt", depths);
  EXPECT_EQ(
      errorOf([&] { openFrameFolder("tum", folder_); }),
      folder_ + "/rgb.txt:5: 101 depth images are within 20 ms of it, expected at most 100");
}

TEST_F(TumDownload, RefusesImagesOutsideTheFolder)
{
  for (const char* file : {"/etc/x.png", "../x.png", "rgb/../../x.png"})
  {
    const std::string what = mrpt::format(":1: '%s' must be a path inside the folder", file);
    write("rgb.txt", mrpt::format("1 %s\n", file));
    const auto error = errorOf([&] { openFrameFolder("tum", folder_); });
    EXPECT_EQ(error, folder_ + "/rgb.txt" + what);
  }
  write("associations.txt", "1 rgb/a.png 1 ../depth/a.png\n");
  EXPECT_EQ(
      errorOf([&] { openFrameFolder("tum", folder_); }),
      folder_ + "/associations.txt:1: '../depth/a.png' must be a path inside the folder");
}

TEST_F(TumDownload, RefusesImagesBehindLinksOutOfTheFolder)
{
  namespace fs = std::filesystem;
  const TemporaryFolder other;
  other.write("secret.png", "");
  fs::create_symlink(other.path("secret.png"), folder_ + "/rgb/link.png");
  fs::create_directory_symlink(other.folder(), folder_ + "/linked");
  for (const std::string name : {"rgb/link.png", "linked/secret.png"})
    for (const bool isColor : {true, false})
    {
      const std::string color = isColor ? name : "rgb/a.png",
                        depth = isColor ? "depth/a.png" : name;
      write("associations.txt", "1 " + color + " 1 " + depth + "\n");
      const auto error = errorOf([&] { openFrameFolder("tum", folder_); });
      EXPECT_NE(error.find(folder_ + "/" + name + ": is a link out of"), std::string::npos)
          << error;
      EXPECT_NE(error.find("associations.txt:1"), std::string::npos) << error;
    }
}

TEST_F(TumDownload, RefusesAbsurdTimes)
{
  write("rgb.txt", "1e300 rgb/a.png\n");
  EXPECT_EQ(
      errorOf([&] { openFrameFolder("tum", folder_); }),
      folder_ + "/rgb.txt:1: the time '1e300' must be in 0..1e10 s");
}

TEST_F(TumDownloadOfOtherName, NeedsTheCameraByName)
{
  EXPECT_THROW(openFrameFolder("tum", folder_), std::runtime_error);
  FrameFolderOptions options;
  options.camera = "fr3";
  const FrameFolder folder = openFrameFolder("tum", folder_, options);
  EXPECT_NEAR(folder.scan(0)->cameraParams.fy(), 539.2, 1e-9);
  EXPECT_FALSE(folder.camera().isDistorted());
}

TEST(FolderKinds, SaysWhatAFolderOfNoKindLacks)
{
  const TemporaryFolder files;
  EXPECT_EQ(
      errorOf([&] { kindOfFolder(files.folder().string()); }).find("is of no known kind (icl has "),
      files.folder().string().size() + 2);
  EXPECT_EQ(errorOf([] { kindOfFolder("/no/such"); }), "/no/such: no such folder");
}
