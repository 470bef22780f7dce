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
constexpr const char* kIdentity = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";

/** A scene in the layout of ScanNet: large colour images, small depth images of a wall at 2 m. */
class ScanNetFolder : public ::testing::Test
{
 protected:
  ScanNetFolder()
  {
    for (const char* sub : {"color", "depth", "pose", "intrinsic"})
      std::filesystem::create_directory(files_.path(sub));
    for (int i : {0, 1, 10})
    {
      writeColor(i, 1296, 968);
      cv::imwrite(
          files_.path(mrpt::format("depth/%d.png", i)),
          cv::Mat(480, 640, CV_16UC1, cv::Scalar(2000)));
      files_.write(
          mrpt::format("pose/%d.txt", i), mrpt::format("1 0 0 %d\n0 1 0 2\n0 0 1 3\n0 0 0 1\n", i));
    }
    files_.write(
        "intrinsic/intrinsic_color.txt", "1170 0 647.5 0\n0 1170 483.5 0\n0 0 1 0\n0 0 0 1\n");
    files_.write(
        "intrinsic/intrinsic_depth.txt", "578 0 319.5 0\n0 578 239.5 0\n0 0 1 0\n0 0 0 1\n");
    files_.write("intrinsic/extrinsic_color.txt", kIdentity);
    files_.write("intrinsic/extrinsic_depth.txt", kIdentity);
  }
  void writeColor(int i, int columns, int rows) const
  {
    cv::Mat image(rows, columns, CV_8UC3, cv::Scalar(0, 0, 0));
    image.colRange(columns / 2, columns).setTo(cv::Scalar(200, 200, 200));
    cv::imwrite(files_.path(mrpt::format("color/%d.jpg", i)), image);
  }
  std::string folder() const { return files_.folder().string(); }

  TemporaryFolder files_;
};
}  // namespace

TEST_F(ScanNetFolder, IsReadInTheSizeOfDepth)
{
  EXPECT_EQ(kindOfFolder(folder()), "scannet");
  const FrameFolder scene = openFrameFolder("scannet", folder());
  ASSERT_EQ(scene.frames().size(), 3u);
  EXPECT_NEAR(scene.frames()[2].time, 10 / 30.0, 1e-9) << "10 comes after 1 and 2";
  const auto scan = scene.scan(2);
  EXPECT_EQ(scan->rangeImage.cols(), 640);
  EXPECT_EQ(scan->intensityImage.getWidth(), 640u);
  EXPECT_EQ(scan->cameraParams.ncols, 640u);
  EXPECT_NEAR(scan->cameraParams.fx(), 1170 * 640 / 1296.0, 1e-9);
  EXPECT_NEAR(static_cast<float>(scan->rangeImage(240, 320)) * scan->rangeUnits, 2.0, 1e-3);
  EXPECT_LT(scan->intensityImage.at<std::uint8_t>(310, 240, 0), 20);
  EXPECT_GT(scan->intensityImage.at<std::uint8_t>(330, 240, 0), 180);
  ASSERT_TRUE(scene.frames()[2].T_world_optical);
  EXPECT_NEAR(scene.frames()[2].T_world_optical->x(), 10, 1e-9);
  EXPECT_NEAR(scene.T_world_robot(2)->z(), 3, 1e-9) << "ScanNet's z is up";
}

TEST_F(ScanNetFolder, ScalesTheCalibrationOfImagesThatWereScaled)
{
  for (int i : {0, 1, 10}) writeColor(i, 640, 480);
  const FrameFolder scene = openFrameFolder("scannet", folder());
  EXPECT_NEAR(scene.scan(0)->cameraParams.fx(), 1170 * 640 / 1296.0, 1e-9);
  bool tells = false;
  for (const auto& note : scene.notes())
    tells |= note.find("is of images of 1296x968") != std::string::npos;
  EXPECT_TRUE(tells);
}

TEST_F(ScanNetFolder, TakesTheSizeThatMostImagesHave)
{
  const double fx = openFrameFolder("scannet", folder()).camera().color.fx();
  const auto expectOthersGood = [&](const std::string& spoilt)
  {
    const FrameFolder scene = openFrameFolder("scannet", folder());
    EXPECT_DOUBLE_EQ(scene.camera().color.fx(), fx) << spoilt;
    EXPECT_NE(errorOf([&] { scene.scan(0); }).find(spoilt), std::string::npos);
    for (std::size_t good : {1u, 2u}) EXPECT_EQ(scene.scan(good)->rangeImage.cols(), 640);
  };
  for (const std::string first : {"color/0.jpg", "depth/0.png"})
  {
    const std::string whole = readFile(files_.path(first));
    for (const std::size_t length : {whole.size() / 2, std::size_t(150), std::size_t(0)})
    {
      files_.write(first, whole.substr(0, length));
      expectOthersGood(first);
    }
    std::filesystem::remove(files_.path(first));
    std::filesystem::create_directory(files_.path(first));
    expectOthersGood(first);
    std::filesystem::remove(files_.path(first));
    files_.write(first, whole);
  }
  writeColor(0, 640, 480);
  expectOthersGood("color/0.jpg: is 640x480, intrinsic/ is for 1296x968");
  for (int i : {0, 1, 10}) files_.write(mrpt::format("color/%d.jpg", i), "");
  EXPECT_NE(
      errorOf([&] { openFrameFolder("scannet", folder()); }).find("color/0.jpg: "),
      std::string::npos);
}

TEST_F(ScanNetFolder, FramesWithoutAKnownPoseHaveNone)
{
  files_.write(
      "pose/1.txt",
      "-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n");
  std::filesystem::remove(files_.path("pose/10.txt"));
  const FrameFolder scene = openFrameFolder("scannet", folder());
  EXPECT_EQ(scene.posesCount(), 1u);
  EXPECT_FALSE(scene.T_world_robot(1));
}

TEST_F(ScanNetFolder, TakesAGivenCameraInsteadOfItsOwn)
{
  for (int i : {0, 1, 10}) writeColor(i, 640, 480);
  FrameFolderOptions options;
  options.camera = files_.write("my.ini", "[camera]\nfx = 500\nfy = 510\nworldUp = 0 1 0\n");
  for (const bool hasOwn : {true, false})
  {
    if (!hasOwn) std::filesystem::remove_all(files_.path("intrinsic"));
    const FrameFolder scene = openFrameFolder("scannet", folder(), options);
    const auto scan = scene.scan(2);
    EXPECT_DOUBLE_EQ(scan->cameraParams.fx(), 500) << hasOwn;
    EXPECT_DOUBLE_EQ(scan->cameraParams.fy(), 510) << hasOwn;
    EXPECT_NEAR(static_cast<float>(scan->rangeImage(240, 320)) * scan->rangeUnits, 2.0, 1e-3)
        << "millimetres, as the camera does not tell";
    EXPECT_EQ(scene.camera().worldUp, Eigen::Vector3d::UnitZ()) << "with any camera";
    EXPECT_EQ(scene.camera().upOrigin, "ScanNet");
    EXPECT_NEAR(scene.T_world_robot(2)->x(), 10, 1e-9) << hasOwn;
  }
}

TEST_F(ScanNetFolder, PosesAreOfTheDepthCameraOfAGivenCamera)
{
  for (int i : {0, 1, 10}) writeColor(i, 640, 480);
  FrameFolderOptions options;
  options.camera = files_.write(
      "my.ini",
      "[camera]\nfx = 500\nfy = 500\ndepthFx = 580\ndepthFy = 580\n"
      "T_color_depth = 1 0 0 0.05 0 1 0 0 0 0 1 0\n");
  const FrameFolder scene = openFrameFolder("scannet", folder(), options);
  EXPECT_NEAR(scene.frames()[2].T_world_optical->x(), 10 - 0.05, 1e-9);
}

TEST_F(ScanNetFolder, AGivenCameraMayHaveDepthOfAnotherSize)
{
  const FrameFolder own = openFrameFolder("scannet", folder());
  FrameFolderOptions options;
  options.camera = files_.write(
      "my.ini",
      "[camera]\nwidth = 1296\nheight = 968\nfx = 1170\nfy = 1170\n"
      "depthWidth = 640\ndepthHeight = 480\ndepthFx = 578\ndepthFy = 578\n");
  std::filesystem::remove_all(files_.path("intrinsic"));
  const FrameFolder given = openFrameFolder("scannet", folder(), options);
  const auto expected = own.scan(1), scan = given.scan(1);
  EXPECT_EQ(scan->cameraParams, expected->cameraParams) << "as intrinsic/ said before";
  EXPECT_TRUE(scan->rangeImage == expected->rangeImage);
  EXPECT_EQ(scan->intensityImage.getWidth(), 640u);
}

TEST_F(ScanNetFolder, SaysHowToGiveTheCameraThatItLacks)
{
  std::filesystem::remove_all(files_.path("intrinsic"));
  EXPECT_EQ(
      errorOf([&] { openFrameFolder("scannet", folder()); }),
      folder() + ": has no intrinsic/, which tells the camera; --camera NAME|FILE gives one");
}

TEST_F(ScanNetFolder, RefusesWhatItCannotUse)
{
  const auto expect = [&](const std::string& file, const std::string& text, const std::string& what)
  {
    const std::string good = readFile(files_.path(file));
    if (text.empty())
      std::filesystem::remove(files_.path(file));
    else
      files_.write(file, text);
    const auto error = errorOf([&] { openFrameFolder("scannet", folder()); });
    EXPECT_NE(error.find(file + what), std::string::npos) << error;
    files_.write(file, good);
  };
  expect("intrinsic/intrinsic_color.txt", "", ": cannot be read");
  expect(
      "intrinsic/intrinsic_depth.txt", "0 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n",
      ": the focal length");
  for (const char* matrix :
       {"5 1 3 0\n0 5 2 0\n0 0 1 0\n0 0 0 1\n", "5 0 3 7\n0 5 2 0\n0 0 2 0\n0 0 0 1\n"})
    expect("intrinsic/intrinsic_depth.txt", matrix, ": is no camera matrix");
  expect("intrinsic/extrinsic_color.txt", "3 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", ": is no rigid");
  std::filesystem::remove_all(files_.path("depth"));
  EXPECT_NE(
      errorOf([&] { openFrameFolder("scannet", folder()); }).find("no images of equal numbers"),
      std::string::npos);
}
