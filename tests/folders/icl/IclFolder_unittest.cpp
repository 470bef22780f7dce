#include <gtest/gtest.h>
#include <mrpt/core/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "../../obs/TemporaryFolder.h"
#include "quadmap/folders/FolderKinds.h"

using namespace quadmap;

namespace
{
/** A recording in the layout of ICL-NUIM: depth before colour, times that count images, and poses
 * that begin with the second image. */
class IclFolder : public ::testing::Test
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

/** Points of a left-handed world with y up, as ICL-NUIM's renderer has it. They are seen from all
 * poses below. */
const Eigen::Matrix<double, 3, 4> kPoints =
    (Eigen::Matrix<double, 3, 4>() << 0, 0.5, 0, 0.1, 1, 1, 1.4, 0.9, 2, 2.1, 2.2, 2.6).finished();

struct LeftHandedPose
{
  Eigen::Vector3d t;
  Eigen::Quaterniond q;
};

/** The camera goes to the right, turns to the left and rolls. */
LeftHandedPose leftHandedPose(int i)
{
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(-0.1 * i, Eigen::Vector3d::UnitY()) *
      Eigen::AngleAxisd(0.05 * i, Eigen::Vector3d::UnitX()) *
      Eigen::AngleAxisd(0.07 * i, Eigen::Vector3d::UnitZ()));
  return {
      {0.1 * i, 1.1, 0.05 * i},
      turn
  };
}

/** A depth image that has the points alone, by the formula of the data set: v = fy y / z + cy with
 * the negative fy. \param pixels Receives where they are. */
cv::Mat imageOfPoints(const LeftHandedPose& pose, std::vector<cv::Point>& pixels)
{
  cv::Mat depth(480, 640, CV_16UC1, cv::Scalar(0));
  for (int k = 0; k < kPoints.cols(); ++k)
  {
    const Eigen::Vector3d p = pose.q.conjugate() * (kPoints.col(k) - pose.t);
    pixels.emplace_back(
        static_cast<int>(std::lround(481.2 * p.x() / p.z() + 319.5)),
        static_cast<int>(std::lround(-480 * p.y() / p.z() + 239.5)));
    depth.at<std::uint16_t>(pixels.back()) = static_cast<std::uint16_t>(std::lround(5000 * p.z()));
  }
  return depth;
}

/** Where a pixel is in the world of a recording. */
Eigen::Vector3d placeOf(const FrameFolder& folder, std::size_t frame, const cv::Point& pixel)
{
  const auto scan = folder.scan(frame);
  const auto& c = scan->cameraParams;
  const double z = static_cast<double>(scan->rangeUnits) * scan->rangeImage(pixel.y, pixel.x);
  // In the sensor's frame: x forward, y left, z up.
  const mrpt::math::TPoint3D p(
      z, -z * (pixel.x - c.cx()) / c.fx(), -z * (pixel.y - c.cy()) / c.fy());
  const auto placed = folder.T_world_robot(frame)->composePoint(p);
  return {placed.x, placed.y, placed.z};
}

double volume(const Eigen::Matrix<double, 3, 4>& points)
{
  return (points.rightCols<3>().colwise() - points.col(0)).determinant();
}
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
  EXPECT_NEAR(scan->cameraParams.fy(), 480, 1e-9);
  EXPECT_FLOAT_EQ(static_cast<float>(scan->rangeImage(9, 9)) * scan->rangeUnits, 1.0f);
}

TEST_F(IclFolder, TakesOneImageOfEachNumber)
{
  std::filesystem::remove(files_.path("associations.txt"));
  files_.write("rgb/2x2.jpg", "");
  files_.write("depth/x03.png", "");
  const FrameFolder room = openFrameFolder("icl", folder());
  ASSERT_EQ(room.listProblems().size(), 2u);
  EXPECT_EQ(room.listProblems()[0], files_.path("rgb/2x2.jpg") + ": has the same number as 2.png");
  EXPECT_EQ(
      room.listProblems()[1], files_.path("depth/x03.png") + ": has the same number as 3.png");
  EXPECT_EQ(room.frames().size(), 4u);
}

TEST_F(IclFolder, PassesOverTheCompanionFilesOfMacOs)
{
  std::filesystem::remove(files_.path("associations.txt"));
  for (const char* name : {"rgb/._1.png", "depth/._1.png", "rgb/._9.png", "._x.gt.freiburg"})
    files_.write(name, "Mac OS X");
  const FrameFolder room = openFrameFolder("icl", folder());
  EXPECT_TRUE(room.listProblems().empty());
  ASSERT_EQ(room.frames().size(), 4u);
  EXPECT_EQ(room.frames()[1].color, files_.path("rgb/1.png"));
  EXPECT_EQ(room.unpaired(), 0u);
}

TEST_F(IclFolder, LeavesOutNumbersThatAreTooLarge)
{
  std::filesystem::remove(files_.path("associations.txt"));
  for (const char* name : {"rgb/18446744073709551615.png", "depth/18446744073709551615.png"})
    files_.write(name, "");
  const FrameFolder room = openFrameFolder("icl", folder());
  ASSERT_EQ(room.listProblems().size(), 1u);
  EXPECT_EQ(
      room.listProblems()[0],
      files_.path("rgb/18446744073709551615.png") + ": its number is too large");
  EXPECT_EQ(room.frames().size(), 4u);
}

TEST_F(IclFolder, RefusesFoldersWithTooManyImagesThatCannotBeUsed)
{
  std::filesystem::remove(files_.path("associations.txt"));
  const auto spoil = [&](const char* name, const char* what)
  {
    for (int i = 0; i < 1001; ++i)
      for (const char* sub : {"rgb", "depth"})
        files_.write(mrpt::format("%s/%s", sub, mrpt::format(name, i).c_str()), "");
    const auto error = errorOf([&] { openFrameFolder("icl", folder()); });
    EXPECT_NE(error.find(": more than 1000 entries cannot be used, such as "), std::string::npos);
    EXPECT_NE(error.find(what), std::string::npos) << error;
  };
  spoil("99999999999%05d.png", ": its number is too large");
  spoil("%05dx_1.png", ": has the same number as ");
}

TEST_F(IclFolder, TurnsItsWorldsYUp)
{
  const FrameFolder room = openFrameFolder("icl", folder());
  const auto T = room.T_world_robot(2);
  ASSERT_TRUE(T);
  EXPECT_NEAR(T->z(), 1.5, 1e-9);
  EXPECT_NEAR(T->x(), 0.2, 1e-9) << "the smallest rotation leaves x alone";
}

TEST_F(IclFolder, WorldIsTheRoomAndNotItsMirrorImage)
{
  std::string poses;
  std::vector<std::vector<cv::Point>> pixels(4);
  for (int i = 0; i < 4; ++i)
  {
    const auto pose = leftHandedPose(i);
    cv::imwrite(
        files_.path(mrpt::format("depth/%d.png", i)),
        imageOfPoints(pose, pixels[static_cast<std::size_t>(i)]));
    poses += mrpt::format(
        "%d %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", i, pose.t.x(), pose.t.y(), pose.t.z(),
        pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w());
  }
  files_.write("livingRoom0.gt.freiburg", poses);
  const FrameFolder room = openFrameFolder("icl", folder());
  Eigen::Matrix<double, 3, 4> first;
  for (std::size_t frame = 0; frame < 4; ++frame)
  {
    Eigen::Matrix<double, 3, 4> places;
    for (int k = 0; k < 4; ++k)
      places.col(k) = placeOf(room, frame, pixels[frame][static_cast<std::size_t>(k)]);
    if (frame == 0) first = places;
    // Pixels round by half of one, which is 3 mm at 2.6 m.
    EXPECT_LT((places - first).cwiseAbs().maxCoeff(), 0.006) << "frame " << frame << " [m]";
    EXPECT_LT((places.row(2) - kPoints.row(1)).cwiseAbs().maxCoeff(), 0.006) << "up is +z";
    EXPECT_NEAR(volume(places), -volume(kPoints), 0.05 * std::abs(volume(kPoints)))
        << "right-handed: the numbers of the recording are those of the mirror image";
  }
}

TEST_F(IclFolder, PairsByNumberWithoutAssociations)
{
  std::filesystem::remove(files_.path("associations.txt"));
  std::filesystem::remove(files_.path("depth/1.png"));
  const FrameFolder room = openFrameFolder("icl", folder());
  ASSERT_EQ(room.frames().size(), 3u);
  EXPECT_EQ(room.unpaired(), 1u);
  EXPECT_EQ(room.firstUnpaired(), files_.path("rgb/1.png"));
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
