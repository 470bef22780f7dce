#include <gtest/gtest.h>
#include <mrpt/maps/COctoMap.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/maps/registerAllClasses.h>
#include <mrpt/obs/CObservation3DScene.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/poses/registerAllClasses.h>

#include "../SampleRawlog.h"
#include "ObjectBytes.h"

using namespace quadmap;
using mrpt::serialization::CSerializable;

namespace
{
class ReadableClasses : public ::testing::Test
{
 protected:
  ReadableClasses()
  {
    mrpt::poses::registerAllClasses_mrpt_poses();
    mrpt::maps::registerAllClasses_mrpt_maps();  // and those of observations and scenes
    registerObsClasses();
  }
};
}  // namespace

TEST_F(ReadableClasses, AreAllObservationsButScenes)
{
  int observations = 0;
  for (const auto* c : mrpt::rtti::getAllRegisteredClasses())
  {
    if (!c->derivedFrom(CLASS_ID(mrpt::obs::CObservation)) || !c->ptrCreateObject) continue;
    const auto object = std::dynamic_pointer_cast<CSerializable>(c->createObject());
    ASSERT_TRUE(object) << c->className;
    ++observations;
    const auto error = errorOf([&] { EXPECT_TRUE(read(bytesOf(*object))); });
    if (c == CLASS_ID(mrpt::obs::CObservation3DScene))
      EXPECT_NE(error.find("class CObservation3DScene is unknown"), std::string::npos) << error;
    else
      EXPECT_EQ(error, "") << c->className;
  }
  EXPECT_GE(observations, 25);
}

TEST_F(ReadableClasses, AreAllPosesOfKeyframes)
{
  for (const char* name :
       {"Gaussian", "GaussianInf", "Particles", "SOG", "QuatPDFGaussian", "QuatPDFGaussianInf"})
  {
    const std::string middle = std::string(name).find("Quat") == 0 ? "" : "PDF";
    const auto* c = mrpt::rtti::findRegisteredClass("mrpt::poses::CPose3D" + middle + name);
    ASSERT_TRUE(c) << name;
    const auto pose = std::dynamic_pointer_cast<CSerializable>(c->createObject());
    EXPECT_TRUE(read(bytesOf(*pose))) << name;
  }
}

TEST_F(ReadableClasses, ArePointCloudsOfObservations)
{
  auto cloud = mrpt::maps::CPointsMapXYZI::Create();
  cloud->insertPoint(1, 2, 3);
  mrpt::obs::CObservationPointCloud observation;
  observation.pointcloud = cloud;
  const auto copy =
      std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(read(bytesOf(observation)));
  ASSERT_TRUE(copy && copy->pointcloud);
  EXPECT_EQ(copy->pointcloud->size(), 1u);
}

TEST_F(ReadableClasses, AreNotThoseOfScenes)
{
  int scenes = 0;
  for (const auto* c : mrpt::rtti::getAllRegisteredClasses())
  {
    const std::string name = c->className;
    if (name.find("mrpt::opengl::") != 0) continue;
    ++scenes;
    const auto error = errorOf([&] { read(named(name) + '\0' + std::string(500, '\0')); });
    EXPECT_NE(error.find("is unknown"), std::string::npos) << name << ": " << error;
  }
  EXPECT_GE(scenes, 30);
}

TEST_F(ReadableClasses, AreNotOctrees)
{
  const auto octree = bytesOf(*mrpt::maps::COctoMap::Create());
  EXPECT_NE(errorOf([&] { read(octree); }).find("class COctoMap is unknown"), std::string::npos);
}

TEST_F(ReadableClasses, AreTheSameWithinOtherObjects)
{
  const std::string whole = bytesOf(*mrpt::opengl::CSetOfObjects::Create());
  const std::string name = "mrpt::opengl::CSetOfObjects";
  ASSERT_EQ(whole.find(named(name)), 0u);
  const std::string content = whole.substr(1 + name.size()), one = number(1);
  const std::string frame = named("mrpt::obs::CSensoryFrame") + "\x02" + one;
  const std::string map = named("mrpt::maps::CSimpleMap") + "\x01" + one;
  for (const auto& outer : {frame, map})
    for (const auto& inner : {name, std::string("CSetOfObjects")})
    {
      const auto error = errorOf([&] { read(outer + named(inner) + content); });
      EXPECT_NE(error.find("class CSetOfObjects is unknown"), std::string::npos) << error;
    }
  const std::string oldName = number(static_cast<std::uint32_t>(name.size())) + name;
  EXPECT_NE(
      errorOf([&] { read(map + oldName + number(1) + content.substr(1)); })
          .find("no longer writes"),
      std::string::npos);
}

TEST_F(ReadableClasses, OtherRecordsAreToldAndLeftOut)
{
  const TemporaryFolder folder;
  const auto file = writeObjects(
      folder.path("x.rawlog"),
      {sampleScan(kStart), mrpt::opengl::CSetOfObjects::Create(), sampleScan(kStart + 1)});
  const auto error = errorOf([&] { readAll(file); });
  EXPECT_NE(
      error.find("x.rawlog: record 1: class mrpt::opengl::CSetOfObjects is unknown, and MRPT "
                 "files do not tell where such an object ends"),
      std::string::npos)
      << error;
  RawlogSourceOptions keepGoing;
  keepGoing.keepGoing = true;
  EXPECT_EQ(readAll(file, keepGoing).size(), 2u);
}
