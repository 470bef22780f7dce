#include <gtest/gtest.h>
#include <mrpt/core/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

#include "../../obs/TemporaryFolder.h"
#include "pcd/Lzf.h"
#include "pcd/PcdFile.h"
#include "quadmap/folders/FolderCheck.h"
#include "quadmap/folders/FolderKinds.h"

using namespace quadmap;

namespace
{
constexpr auto kNotFound = std::string::npos;
constexpr int kColumns = 32, kRows = 24;
constexpr double kFocal = 30.0, kCx = 15.0, kCy = 12.0;

/** The bytes of a number. */
template <typename T>
std::string bytesOf(T value)
{
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

/** Packs into literal runs only, which is one way to write LZF. */
std::string packed(const std::string& plain)
{
  constexpr std::size_t kLongest = 32;
  std::string out;
  for (std::size_t at = 0; at < plain.size(); at += kLongest)
  {
    const std::string piece = plain.substr(at, kLongest);
    out += static_cast<char>(piece.size() - 1);
    out += piece;
  }
  return out;
}

/** Clouds of a slanted wall, of which a corner is not measured, in each way of writing them. */
class PcdFolder : public ::testing::Test
{
 protected:
  static float depthAt(int u, int v)
  {
    if (u < 4 && v < 4) return std::numeric_limits<float>::quiet_NaN();
    return 1.0f + 0.01f * static_cast<float>(u) + 0.02f * static_cast<float>(v);
  }
  static Eigen::Vector3f pointAt(int u, int v)
  {
    const float z = depthAt(u, v);
    return {
        static_cast<float>((u - kCx) / kFocal) * z, static_cast<float>((v - kCy) / kFocal) * z, z};
  }
  static std::uint32_t colorAt(int u, int v)
  {
    return static_cast<std::uint32_t>((200 << 16) | (u << 8) | v);
  }

  static std::string header(const std::string& data, const std::string& viewpoint)
  {
    return mrpt::format(
        "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z label rgb\nSIZE 4 4 4 1 4\nTYPE F F F U U\n"
        "COUNT 1 1 1 1 1\nWIDTH %d\nHEIGHT %d\nVIEWPOINT %s\nPOINTS %d\nDATA %s\n",
        kColumns, kRows, viewpoint.c_str(), kColumns * kRows, data.c_str());
  }

  /** \param shift Of the points to the right [m]. */
  void write(
      const std::string& name,
      const std::string& data,
      const std::string& viewpoint = "0 0 0 1 0 0 0",
      float shift = 0) const
  {
    std::string points;
    std::string fields[5];
    for (int v = 0; v < kRows; ++v)
      for (int u = 0; u < kColumns; ++u)
      {
        const Eigen::Vector3f p = pointAt(u, v) + Eigen::Vector3f(shift, 0, 0);
        const std::string values[5] = {
            bytesOf(p.x()), bytesOf(p.y()), bytesOf(p.z()), "L", bytesOf(colorAt(u, v))};
        for (int i = 0; i < 5; ++i) fields[i] += values[i];
        if (data == "ascii")
          points += mrpt::format("%.9g %.9g %.9g 76 %u\n", p.x(), p.y(), p.z(), colorAt(u, v));
        else
          for (const auto& value : values) points += value;
      }
    if (data == "binary_compressed")
    {
      const std::string plain = fields[0] + fields[1] + fields[2] + fields[3] + fields[4];
      const std::string small = packed(plain);
      points = bytesOf(static_cast<std::uint32_t>(small.size())) +
               bytesOf(static_cast<std::uint32_t>(plain.size())) + small;
    }
    files_.write(name, header(data, viewpoint) + points);
  }
  std::string folder() const { return files_.folder().string(); }

  TemporaryFolder files_;
};
}  // namespace

TEST_F(PcdFolder, AllWaysOfWritingGiveTheSameCloud)
{
  for (const char* data : {"ascii", "binary", "binary_compressed"})
  {
    write("a.pcd", data);
    const PcdCloud cloud = readPcd(files_.path("a.pcd"));
    ASSERT_EQ(cloud.x.size(), std::size_t{kColumns * kRows}) << data;
    for (int v = 0, i = 0; v < kRows; ++v)
      for (int u = 0; u < kColumns; ++u, ++i)
      {
        const auto k = static_cast<std::size_t>(i);
        ASSERT_EQ(cloud.color[k], colorAt(u, v)) << data;
        ASSERT_EQ(std::isfinite(cloud.z[k]), std::isfinite(depthAt(u, v))) << data;
        if (!std::isfinite(cloud.z[k])) continue;
        ASSERT_EQ(Eigen::Vector3f(cloud.x[k], cloud.y[k], cloud.z[k]), pointAt(u, v)) << data;
      }
  }
}

TEST(Lzf, CopiesWhatWasUnpackedBefore)
{
  // "abc", then 7 bytes from 3 back, which reach into themselves, then 11 bytes from 1 back.
  const std::uint8_t bytes[] = {2, 'a', 'b', 'c', (5 << 5) | 0, 2, (7 << 5) | 0, 2, 0};
  const auto plain = unpackedLzf(bytes, sizeof bytes, 21);
  ASSERT_TRUE(plain);
  EXPECT_EQ(std::string(plain->begin(), plain->end()), "abcabcabca" + std::string(11, 'a'));
  for (std::size_t size = 0; size < sizeof bytes; ++size)
    EXPECT_FALSE(unpackedLzf(bytes, size, 21)) << "cut off after " << size;
  EXPECT_FALSE(unpackedLzf(bytes, sizeof bytes, 20));
  EXPECT_FALSE(unpackedLzf(bytes, sizeof bytes, std::size_t{1} << 40)) << "takes no memory for it";
  const std::uint8_t before[] = {0, 'a', (1 << 5), 1};
  EXPECT_FALSE(unpackedLzf(before, sizeof before, 4)) << "copies what is before the beginning";
}

TEST_F(PcdFolder, CameraFollowsFromThePoints)
{
  write("b.pcd", "binary");
  write("a.pcd", "ascii");
  EXPECT_EQ(kindOfFolder(folder()), "pcd");
  const FrameFolder clouds = openFrameFolder("pcd", folder());
  ASSERT_EQ(clouds.frames().size(), 2u);
  EXPECT_EQ(clouds.frames()[0].listed, "a.pcd");
  EXPECT_NEAR(clouds.frames()[1].time, 1 / 30.0, 1e-9);
  const auto scan = clouds.scan(1);
  EXPECT_NEAR(scan->cameraParams.fx(), kFocal, 1e-3);
  EXPECT_NEAR(scan->cameraParams.cy(), kCy, 1e-3);
  EXPECT_EQ(scan->rangeImage(2, 2), 0) << "not measured";
  EXPECT_NEAR(
      static_cast<float>(scan->rangeImage(10, 20)) * scan->rangeUnits, depthAt(20, 10), 2e-4);
  EXPECT_EQ(scan->intensityImage.at<std::uint8_t>(20, 10, 2), 200) << "red";
  EXPECT_EQ(scan->intensityImage.at<std::uint8_t>(20, 10, 1), 20) << "green";
  EXPECT_EQ(scan->intensityImage.at<std::uint8_t>(20, 10, 0), 10) << "blue";
  EXPECT_FALSE(clouds.T_world_robot(0)) << "the default viewpoint is no pose";
}

TEST_F(PcdFolder, TakesPosesFromWhereTheyAre)
{
  write("10.25.pcd", "binary", "0 0 0 1 0 0 0");
  write("10.50.pcd", "binary", "1 2 3 0 1 0 0");
  const auto second = [&] { return *openFrameFolder("pcd", folder()).frames()[1].T_world_optical; };
  EXPECT_NEAR(second().y(), 2, 1e-9) << "of the headers";
  EXPECT_NEAR(second().getRotationMatrix()(1, 1), -1, 1e-9) << "the quaternion begins with w";
  files_.write("groundtruth.txt", "10.25 0 0 0 0 0 0 1\n10.5 0 5 0 0 0 0 1\n");
  EXPECT_NEAR(second().y(), 5, 1e-9) << "of the trajectory, by the times in the names";
  files_.write("10.50.txt", "1 0 0 0\n0 1 0 7\n0 0 1 0\n0 0 0 1\n");
  EXPECT_NEAR(second().y(), 7, 1e-9) << "of the matrix beside the cloud";
}

TEST_F(PcdFolder, HasNoPointsAfterAHeaderWithoutItsLineEnd)
{
  for (const char* data : {"ascii", "binary", "binary_compressed"})
  {
    std::string text = header(data, "0 0 0 1 0 0 0");
    text.pop_back();
    const auto path = files_.write("a.pcd", text);
    EXPECT_EQ(errorOf([&] { readPcd(path); }).find(path + ": ends before its "), 0u) << data;
  }
}

TEST_F(PcdFolder, OrdersCloudsByTimeOrNumber)
{
  const auto order = [&]
  {
    std::string names;
    const FrameFolder clouds = openFrameFolder("pcd", folder());
    for (const auto& frame : clouds.frames()) names += frame.listed + " ";
    return names;
  };
  for (const char* name : {"c10.pcd", "c9.pcd"}) write(name, "binary");
  EXPECT_EQ(order(), "c9.pcd c10.pcd ");
  for (const char* name : {"c10.pcd", "c9.pcd"}) std::filesystem::remove(files_.path(name));
  for (const char* name : {"10.5.pcd", "9.75.pcd"}) write(name, "binary");
  files_.write("._9.75.pcd", "Mac OS X");
  EXPECT_EQ(order(), "9.75.pcd 10.5.pcd ");
  write("1.0e300.pcd", "binary");
  EXPECT_EQ(order(), "9.75.pcd 10.5.pcd ");
  const std::string problem = folder() + "/1.0e300.pcd: the time in its name must be in 0..1e10 s";
  EXPECT_EQ(openFrameFolder("pcd", folder()).listProblems(), std::vector{problem});
}

TEST_F(PcdFolder, RefusesWhatItCannotUse)
{
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& what)
  {
    write("a.pcd", "ascii");
    std::string text = readFile(files_.path("a.pcd"));
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    files_.write("a.pcd", text.replace(at, from.size(), to));
    const auto error = errorOf([&] { openFrameFolder("pcd", folder()); });
    EXPECT_NE(error.find("a.pcd: " + what), std::string::npos) << error;
  };
  expect("HEIGHT 24", "HEIGHT 1", "is not organised");
  expect("DATA ascii", "DATA text", "DATA text is not");
  expect("DATA ascii", "NOTE ascii", "is no PCD file");
  expect("label rgb", "label red", "has no field rgb");
  expect("SIZE 4", "SIZE 8", "the field x has not 4 bytes");
  expect("SIZE 4 4 4 1", "SIZE -4 4 4 1", "each SIZE of the header must be 1, 2, 4 or 8");
  expect("COUNT 1 1 1 1", "COUNT 1 1 1 -1", "each COUNT of the header must be in 1..4096");
  expect("COUNT 1 1 1 1", "COUNT 1 1 1 4000", "ends before its last point");
  expect("VIEWPOINT 0 0 0 1", "VIEWPOINT 0 0 0 x", "VIEWPOINT is no pose");
  expect("VIEWPOINT 0 0 0 1", "VIEWPOINT 0 0 0 0", "the quaternion of VIEWPOINT is zero");
  for (const char* q : {"1e300", "2", "0.94"})
    expect(
        "VIEWPOINT 0 0 0 1", std::string("VIEWPOINT 0 0 0 ") + q,
        "the quaternion of VIEWPOINT has the length");
  expect("HEIGHT 24", "HEIGHT 25", "ends before its last point");
  expect("HEIGHT 24", "HEIGHT 24000\nCOUNT 1 1 1 4000 1", "has points of more than 256 MB");
  std::string names;
  for (int i = 0; i < 5000; ++i) names += " n";
  expect("FIELDS x", "FIELDS" + names + " x", "has too many fields");
  expect("VERSION 0.7", "VERSION " + std::string(2'000'000, '7'), "has a line of more than 1 MB");
  expect("VERSION 0.7", std::string(1000, '\n'), "is no PCD file");
  expect("WIDTH 32", "WIDTH 99999999999", "has too many points");
  expect("nan nan nan 76", "nan nan x 76", "point 0: 'x' is not a number");
  // x forward, y left, z up, as in the frame of a robot.
  write("a.pcd", "binary");
  expect("FIELDS x y z", "FIELDS z x y", "its points are not those of a camera's image");
}

TEST_F(PcdFolder, RefusesLaterCloudsOfAnotherCamera)
{
  write("a.pcd", "binary");
  write("b.pcd", "binary", "0 0 0 1 0 0 0", 0.5F);
  const FrameFolder clouds = openFrameFolder("pcd", folder());
  EXPECT_NO_THROW(clouds.scan(0));
  const auto error = errorOf([&] { clouds.scan(1); });
  const std::string other = files_.path("a.pcd");
  EXPECT_NE(
      error.find("b.pcd: its points are not those of the camera of " + other + ", which"),
      kNotFound)
      << error;
}

TEST_F(PcdFolder, AnAbsurdPoseIsNamedByItsPath)
{
  write("a.pcd", "binary", "1e30 0 0 1 0 0 0");
  write("b.pcd", "binary", "1 0 0 1 0 0 0");
  const FrameFolder clouds = openFrameFolder("pcd", folder());
  const std::string& problem = clouds.frames()[0].poseProblem;
  EXPECT_EQ(problem.find(files_.path("a.pcd") + ": its pose "), 0u) << problem;
}

TEST_F(PcdFolder, ADamagedCloudOrPoseSpoilsItsFrameAlone)
{
  write("a.pcd", "binary");
  write("b.pcd", "binary");
  files_.write("a.pcd", readFile(files_.path("a.pcd")).substr(0, 500));
  files_.write("a.txt", "2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  files_.write("b.txt", "1 0 0 0\n0 1 0 7\n0 0 1 0\n0 0 0 1\n");
  const FrameFolder clouds = openFrameFolder("pcd", folder());
  EXPECT_NEAR(clouds.scan(1)->cameraParams.fx(), kFocal, 1e-3) << "of the next cloud";
  EXPECT_EQ(clouds.camera().origin, "b.pcd");
  EXPECT_NE(errorOf([&] { clouds.scan(0); }).find("a.pcd: ends before"), kNotFound);
  EXPECT_NE(clouds.frames()[0].poseProblem.find("a.txt: is no rigid transformation"), kNotFound);
  EXPECT_TRUE(clouds.T_world_robot(1));
  const auto problems = checkFolder(clouds, {}, [](double) {});
  EXPECT_EQ(problems.count("pose"), 1u);
  EXPECT_EQ(problems.count("image"), 1u);
  EXPECT_EQ(problems.count("no pose"), 0u) << "it is told once";
  std::filesystem::remove(files_.path("a.txt"));
  std::filesystem::remove(files_.path("b.txt"));
  EXPECT_EQ(openFrameFolder("pcd", folder()).posesCount(), 0u) << "the headers have none";
}
