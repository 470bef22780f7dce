#include <gtest/gtest.h>
#include <mrpt/serialization/CArchive.h>

#include "../../base/OptionGroupLaws.h"
#include "quadmap/simulator/SimulatorOptions.h"
#include "quadmap/slam/SlamConfiguration.h"

// Every group of options of the project: it saves without loss, refuses what is wrong, and says
// what its options do.
namespace quadmap
{
namespace
{
TEST(OptionGroups, OfTheProgramKeepTheLaws)
{
  expectLaws<SlamOptions>("slam");
  expectLaws<InputOptions>("input");
  expectLaws<KeyframeOptions>("keyframes");
  expectLaws<PoseUncertaintyOptions>("poses");
  expectLaws<JointOptions>("joint");
  expectLaws<PointOptions>("point");
  expectLaws<RelocalizationOptions>("relocalization");
  expectLaws<VisualOdometryOptions>("visual");
  expectLaws<PerceptionOptions>("perception");
}

TEST(OptionGroups, OfTheMapKeepTheLaws)
{
  expectLaws<InsertionOptions>("x_insertOpts");
  expectLaws<LikelihoodOptions>("x_likelihoodOpts");
  expectLaws<RenderOptions>("x_renderOpts");
}

TEST(OptionGroups, OfTheSimulatorKeepTheLaws)
{
  expectLaws<simulator::CameraOptions>("camera");
  expectLaws<simulator::TrajectoryOptions>("trajectory");
  expectLaws<simulator::DepthNoiseOptions>("depth_noise");
  expectLaws<simulator::OdometryOptions>("odometry");
  expectLaws<simulator::DetectorOptions>("detector");
}

TEST(OptionGroups, SurviveTheArchiveOfTheMapBitForBit)
{
  CQuadricObjectMap map;
  map.insertionOptions.association.newObjectVolume = 1.0 / 3;
  map.insertionOptions.poseNoise.angle = 1.0 / 3;
  map.likelihoodOptions.yawSigma = 1.0 / 7;
  map.renderOptions.opacity = 1.0 / 3;
  map.perceptionOptions.maxRange = 10.0 / 3;
  map.perceptionOptions.planeMaxTilt = 1.0 / 7;
  map.perceptionOptions.models = ObservationModels::Partial;
  std::vector<std::uint8_t> bytes;
  mrpt::serialization::ObjectToOctetVector(&map, bytes);
  mrpt::serialization::CSerializable::Ptr object;
  mrpt::serialization::OctetVectorToObject(bytes, object);
  const auto loaded = std::dynamic_pointer_cast<CQuadricObjectMap>(object);
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->insertionOptions.association.newObjectVolume, 1.0 / 3);
  EXPECT_EQ(loaded->insertionOptions.poseNoise.angle, 1.0 / 3);
  EXPECT_EQ(loaded->likelihoodOptions.yawSigma, 1.0 / 7);
  EXPECT_EQ(loaded->renderOptions.opacity, 1.0 / 3);
  EXPECT_EQ(loaded->perceptionOptions.maxRange, 10.0 / 3);
  EXPECT_EQ(loaded->perceptionOptions.planeMaxTilt, 1.0 / 7);
  EXPECT_EQ(loaded->perceptionOptions.models, ObservationModels::Partial);
}

TEST(OptionGroups, TheSharedFileIsTheDocumentedDefaults)
{
  EXPECT_EQ(
      readFile(QUADMAP_SOURCE_DIR "/share/quadmap/quadmap.ini"),
      SlamConfiguration().documentedIni())
      << "write it with: quadmap-slam --defaults > share/quadmap/quadmap.ini";
}

}  // namespace
}  // namespace quadmap
