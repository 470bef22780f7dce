#include "quadmap/sensors/SimpleMapReader.h"

#include <gtest/gtest.h>
#include <mrpt/serialization/CSerializable.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "../obs/TemporaryFolder.h"
#include "SampleScene.h"
#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/review/KeyframeContent.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

namespace
{
constexpr int kKeyframes = 5;

class SimpleMapFile : public ::testing::Test
{
 protected:
  SimpleMapFile() : path_(folder_.path("map.simplemap"))
  {
    mrpt::maps::CSimpleMap map;
    for (int i = 0; i < kKeyframes; ++i) addKeyframe(map, CPose3D(i, 0, 0, 0, 0, 0), scanOfWall());
    EXPECT_TRUE(map.saveToFile(path_));
  }

  TemporaryFolder folder_;
  std::string path_;
};
}  // namespace

TEST_F(SimpleMapFile, IsReadKeyframeByKeyframe)
{
  SimpleMapReader reader(path_);
  EXPECT_EQ(reader.size(), static_cast<std::size_t>(kKeyframes));
  for (int i = 0; i < kKeyframes; ++i)
  {
    const auto keyframe = reader.next();
    ASSERT_TRUE(keyframe);
    EXPECT_NEAR(keyframe->pose->getMeanVal().x(), i, 1e-12);
    ASSERT_EQ(keyframe->observations->size(), 1u);
  }
  EXPECT_FALSE(reader.next());
  EXPECT_FALSE(reader.next());
}

TEST_F(SimpleMapFile, AFileWithoutItsLastBytesIsAnError)
{
  const std::string whole = readFile(path_);
  for (const std::size_t cut : {1u, 8u, 50u})
  {
    folder_.write("map.simplemap", whole.substr(0, whole.size() - cut));
    SceneContent content;
    const std::string error = errorOf([&] { addKeyframes(path_, {}, content); });
    EXPECT_NE(error.find(path_), std::string::npos) << cut;
    EXPECT_NE(error.find("truncated"), std::string::npos) << error;
  }
}

TEST_F(SimpleMapFile, AFileThatGoesOnAfterTheLastKeyframeIsAnError)
{
  const std::string whole = readFile(path_);
  folder_.write("map.simplemap", whole + whole);
  SceneContent content;
  EXPECT_EQ(
      errorOf([&] { addKeyframes(path_, {}, content); }),
      path_ + ": more follows the last keyframe");
}

TEST_F(SimpleMapFile, GivesCamerasAndACloud)
{
  SceneContent content;
  addKeyframes(path_, {}, content);
  ASSERT_EQ(content.cameras.size(), static_cast<std::size_t>(kKeyframes));
  EXPECT_NEAR(content.cameras[3].T_map_sensor.x(), 3, 1e-12);
  EXPECT_NEAR(content.cameras[3].horizontalFov, 2 * std::atan(64.0 / 120.0), 1e-9);
  EXPECT_GT(content.cloud.size(), 1000u);
  for (const CloudPoint& p : content.cloud)
    EXPECT_NEAR(p.position.x(), std::round(p.position.x()), 1e-3) << "walls 2 m before each robot";
}

TEST_F(SimpleMapFile, TakesOnlySomeKeyframesWhenThereAreMany)
{
  CloudOptions options;
  options.maxKeyframes = 2;  // of 5: each third one
  SceneContent content;
  addKeyframes(path_, options, content);
  EXPECT_EQ(content.cameras.size(), static_cast<std::size_t>(kKeyframes));
  for (const CloudPoint& p : content.cloud)
    EXPECT_TRUE(std::abs(p.position.x() - 2) < 0.01 || std::abs(p.position.x() - 5) < 0.01);
}

TEST_F(SimpleMapFile, TakesSomeOfEachCamera)
{
  mrpt::maps::CSimpleMap map;  // with two cameras that take turns
  for (int i = 0; i < 8; ++i)
  {
    const auto scan = scanOfWall();
    scan->sensorLabel = i % 2 == 0 ? "front" : "rear";
    addKeyframe(map, CPose3D(3 * (i % 2), 0, 0, 0, 0, 0), scan);
  }
  ASSERT_TRUE(map.saveToFile(path_));
  CloudOptions options;
  options.maxKeyframes = 4;
  SceneContent content;
  addKeyframes(path_, options, content);
  for (const double wall : {2.0, 5.0})
    EXPECT_TRUE(std::any_of(
        content.cloud.begin(), content.cloud.end(),
        [&](const CloudPoint& p) { return std::abs(p.position.x() - wall) < 0.01; }))
        << wall;
}

TEST_F(SimpleMapFile, TruncatedIsReportedWithItsKeyframe)
{
  const std::string whole = readFile(path_);
  const std::string path = folder_.write("short.simplemap", whole.substr(0, whole.size() / 2));
  SceneContent content;
  const std::string error = errorOf([&] { addKeyframes(path, {}, content); });
  EXPECT_NE(error.find("short.simplemap: keyframe"), std::string::npos) << error;
  EXPECT_NE(error.find("of 5"), std::string::npos) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos);
}

TEST_F(SimpleMapFile, AnUnknownClassIsNamed)
{
  mrpt::maps::CSimpleMap map;
  addKeyframe(map, CPose3D(), scanOfWall());
  std::vector<std::uint8_t> bytes;
  mrpt::serialization::ObjectToOctetVector(&map, bytes);
  std::string file(bytes.begin(), bytes.end());
  const std::string known = "mrpt::obs::CSensoryFrame", unknown = "other::obs::SensoryFrame";
  const auto at = file.find(known);
  ASSERT_NE(at, std::string::npos);
  file.replace(at, known.size(), unknown);
  SimpleMapReader reader(folder_.write("map.simplemap", file));
  EXPECT_EQ(
      errorOf([&] { reader.next(); }),
      path_ + ": keyframe 1 of 1: class " + unknown +
          " is unknown, and MRPT files do not tell where such an object ends");
}

TEST_F(SimpleMapFile, PosesThatAreNoneAreReported)
{
  const auto errorWith = [&](const CPose3D& T_map_robot, const CPose3D& T_robot_sensor)
  {
    mrpt::maps::CSimpleMap map;
    const auto scan = scanOfWall();
    scan->sensorPose = T_robot_sensor;
    addKeyframe(map, T_map_robot, scan);
    EXPECT_TRUE(map.saveToFile(path_));
    SceneContent content;
    return errorOf([&] { addKeyframes(path_, {}, content); });
  };
  CPose3D mirrored;
  const Eigen::Vector3d mirror(-1, 1, 1);
  mirrored.setRotationMatrix(mrpt::math::CMatrixDouble33(Eigen::Matrix3d(mirror.asDiagonal())));
  EXPECT_EQ(errorWith({}, {}), "");
  EXPECT_EQ(
      errorWith(CPose3D(0, 1e300, 0, 0, 0, 0), {}),
      path_ + ": keyframe 1 of 1: its pose is 1e+300 m away, which is absurd");
  EXPECT_NE(errorWith({}, mirrored).find("has no rotation"), std::string::npos);
}

TEST_F(SimpleMapFile, BoxesThatAreNoneAreReported)
{
  const auto errorWith = [&](const ImageBox& box)
  {
    mrpt::maps::CSimpleMap map;
    const auto boxes = CObservationObjects::Create();
    boxes->sensorLabel = "camera";
    boxes->cameraParams.ncols = 64;
    boxes->cameraParams.nrows = 48;
    boxes->objects.emplace_back();
    boxes->objects[0].label = "cup";
    boxes->objects[0].box = box;
    mrpt::obs::CSensoryFrame observations;
    observations.insert(boxes);
    map.insert(mrpt::poses::CPose3DPDFGaussian(), observations);
    EXPECT_TRUE(map.saveToFile(path_));
    SimpleMapReader reader(path_);
    return errorOf([&] { reader.next(); });
  };
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const ImageBox& usual : {
           ImageBox{-9, 1, 70, 9},
           { 5, 5,  5, 5},
           {-9, 1, -2, 9}
  })
    EXPECT_EQ(errorWith(usual), "");
  for (const ImageBox& absurd : {
           ImageBox{-1e300, 1, 1e300,    9},
           {     1, 1,     9, kNaN}
  })
    EXPECT_EQ(
        errorWith(absurd),
        path_ + ": keyframe 1 of 1: box 1 of 1 (cup) of camera lies far outside the image");
}

TEST_F(SimpleMapFile, OtherFilesAreReported)
{
  const std::string missing = folder_.path("nothing.simplemap");
  EXPECT_NE(
      errorOf([&] { SimpleMapReader reader(missing); }).find("cannot be read"), std::string::npos);
  EXPECT_FALSE(errorOf([&] { SimpleMapReader reader(folder_.folder().string()); }).empty());
  for (const char* content : {"", "x", "\x96mrpt::maps::CSimpleMaq\x01", "a long text of no use"})
  {
    const std::string path = folder_.write("other.simplemap", content);
    const std::string error = errorOf([&] { SimpleMapReader reader(path); });
    EXPECT_NE(error.find("other.simplemap: is not a simple map"), std::string::npos) << error;
  }
}
