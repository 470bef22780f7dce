#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <Eigen/Dense>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "../obs/TestData.h"
#include "../sensors/SampleRawlog.h"
#include "ImportFixture.h"

using namespace quadmap;

TEST_F(QuadmapImport, SaysThatUpIsNotKnown)
{
  auto calibration = std::string(SampleRecording::kCalibration);
  recording_.writeCalibration(calibration.substr(0, calibration.find("world_up")));
  const auto result = run("tum IN -o OUT/x.rawlog");
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find("up: taken as +z, as nothing says where it is"), kNotFound);
  EXPECT_NE(run("tum IN --check").out.find("  up: taken as +z"), kNotFound);
}

/** A recording whose camera sees planes, and does not say where up is. */
class UpOfPlanes : public QuadmapImport
{
 protected:
  /** \param normals Of planes that are 1.2 m from the camera and look at it; optical frame. */
  void show(const std::vector<Eigen::Vector3d>& normals)
  {
    constexpr int kWidth = 320, kHeight = 240;
    constexpr double kFocal = 300, kCx = 159.5, kCy = 119.5;  // [px]
    recording_.writeCalibration(
        "fx: 300.0\nfy: 300.0\ncx: 159.5\ncy: 119.5\nwidth: 320\nheight: 240\n"
        "depth_factor: 5000.0\n");
    cv::Mat depth(kHeight, kWidth, CV_16UC1);
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u)
      {
        const Eigen::Vector3d ray((u - kCx) / kFocal, (v - kCy) / kFocal, 1);
        double nearness = 0;  // of the nearest plane
        for (const auto& n : normals) nearness = std::max(nearness, -n.dot(ray));
        depth.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(5000 * 1.2 / nearness);
      }
    for (int i = 0; i < SampleRecording::kFrames; ++i)
    {
      recording_.writeColor(i, kWidth, kHeight);
      cv::imwrite(recording_.files.path(mrpt::format("depth/f%d.png", i)), depth);
    }
  }

  /** Imports it. \param up Optical frame. \param by How the program says it found that. */
  void expectUp(const Eigen::Vector3d& up, const std::string& by)
  {
    const auto result = run("tum IN -o OUT/x.rawlog");
    EXPECT_EQ(result.status, 0);
    EXPECT_NE(result.err.find(by), kNotFound) << result.err;
    const auto frames = readAll(out_.path("x.rawlog"));
    const Eigen::Vector3d up_robot(up.z(), -up.x(), -up.y());  // x forward, y left, z up
    const Eigen::Vector3d up_map =
        frames.at(0).T_odom_robot->getRotationMatrix().asEigen() * up_robot;
    EXPECT_GT(up_map.z(), std::cos(mrpt::DEG2RAD(1.0))) << up_map.transpose();
  }
};

TEST_F(UpOfPlanes, IsTheFloors)
{
  const Eigen::Vector3d up = Eigen::Vector3d(0.1, -0.8, -0.6).normalized();
  show({up});
  expectUp(up, "by the floor in 6 images of 6");
}

TEST_F(UpOfPlanes, IsAlongTwoWalls)
{
  const Eigen::Vector3d up = Eigen::Vector3d(0.1, -0.9, -0.3).normalized();
  const Eigen::Vector3d left = up.cross(Eigen::Vector3d(1, 0, -1)).normalized();
  const Eigen::Vector3d right = up.cross(left);
  show({left.z() < 0 ? left : -left, right.z() < 0 ? right : -right});
  expectUp(up, "by horizontal and vertical surfaces in 6 images of 6 without a floor");
}

TEST_F(QuadmapImport, FindsTheUpOfARealRecording)
{
  const auto raw = testData("seven_scenes_raw"), kitchen = testData("kitchen_a");
  if (raw.empty() || kitchen.empty()) GTEST_SKIP() << "the recordings are not here";
  const auto result = run("auto " + raw + " -o OUT/raw.rawlog");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("by the floor in "), kNotFound) << result.err;
  ASSERT_EQ(run("tum " + kitchen + " -o OUT/kitchen.rawlog --every 8").status, 0);
  const auto found = readAll(out_.path("raw.rawlog")), known = readAll(out_.path("kitchen.rawlog"));
  ASSERT_EQ(found.size(), 31u);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    ASSERT_NEAR(found[i].time(), known[i].time(), 1e-3);
    const auto upOf = [](const RgbdFrame& frame)
    { return Eigen::Vector3d(frame.T_odom_robot->getRotationMatrix().asEigen().row(2)); };
    // The two sets of poses differ by 1.4 to 3.7 degrees from each other.
    EXPECT_GT(upOf(found[i]).dot(upOf(known[i])), std::cos(mrpt::DEG2RAD(4.5))) << i;
  }
}
