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
/** A recording in the layout of ICL-NUIM: depth before colour, times that count images, and poses
 * that begin with the second image. */
class IclFolder : public testing::Test
{
 protected:
  IclFolder()
  {
    std::string associations, poses;
    for (const char* sub : {"rgb", "depth"}) std::filesystem::create_directory(files_.path(sub));
    for (int i = 0; i < 4; ++i)
    {
      cv::imwrite(
          files_.path(mrpt::format("rgb/%d.png", i)),
          cv::Mat(480, 640, CV_8UC3, cv::Scalar(9, 8, 7)));
      cv::imwrite(
          files_.path(mrpt::format("depth/%d.png", i)),
          cv::Mat(480, 640, CV_16UC1, cv::Scalar(5000)));
      associations += mrpt::format("%d depth/%d.png %d rgb/%d.png\n", i, i, i, i);
      if (i > 0) poses += mrpt::format("%d 0.%d 1.5 -2.25 0 0 0 1\n", i, i);
    }
    files_.write("associations.txt", associations);
    files_.write("livingRoom0.gt.freiburg", poses);
  }
  std::string folder() const { return files_.folder().string(); }

  TemporaryFolder files_;
};
}  // namespace

TEST_F(IclFolder, IsReadAsDownloaded)
{
  EXPECT_EQ(kindOfFolder(folder()), "icl") << "although it has associations.txt, as tum";
  const FrameFolder room = openFrameFolder("icl", folder());
  ASSERT_EQ(room.frames().size(), 4u);
  EXPECT_EQ(room.frames()[2].color, files_.path("rgb/2.png"));
  EXPECT_EQ(room.frames()[2].depth, files_.path("depth/2.png"));
  EXPECT_EQ(room.posesCount(), 3u) << "the first image has none";
  const auto scan = room.scan(2);
  EXPECT_NEAR(scan->cameraParams.fy(), -480, 1e-9);
  EXPECT_FLOAT_EQ(static_cast<float>(scan->rangeImage(9, 9)) * scan->rangeUnits, 1.0f);
}

TEST_F(IclFolder, TurnsItsWorldsYUp)
{
  const FrameFolder room = openFrameFolder("icl", folder());
  const auto T = room.T_world_robot(2);
  ASSERT_TRUE(T);
  EXPECT_NEAR(T->z(), 1.5, 1e-9);
  EXPECT_NEAR(T->x(), 0.2, 1e-9) << "the smallest rotation leaves x alone";
}

TEST_F(IclFolder, PairsByNumberWithoutAssociations)
{
  std::filesystem::remove(files_.path("associations.txt"));
  std::filesystem::remove(files_.path("depth/1.png"));
  const FrameFolder room = openFrameFolder("icl", folder());
  ASSERT_EQ(room.frames().size(), 3u);
  EXPECT_EQ(room.unpaired(), 1u);
  EXPECT_DOUBLE_EQ(room.frames()[1].time, 2) << "as in the trajectory";
  EXPECT_EQ(room.posesCount(), 2u);
}

TEST_F(IclFolder, WantsOneTrajectory)
{
  files_.write("livingRoom1.gt.freiburg", "1 0 0 0 0 0 0 1\n");
  EXPECT_NE(
      errorOf([&] { openFrameFolder("icl", folder()); }).find("has several trajectories"),
      std::string::npos);
  std::filesystem::remove(files_.path("livingRoom0.gt.freiburg"));
  std::filesystem::rename(files_.path("livingRoom1.gt.freiburg"), files_.path("groundtruth.txt"));
  EXPECT_EQ(openFrameFolder("icl", folder()).posesCount(), 1u);
}
