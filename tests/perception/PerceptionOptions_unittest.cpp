#include "quadmap/perception/PerceptionOptions.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

namespace quadmap
{
namespace
{
PerceptionOptions read(const std::string& line)
{
  mrpt::config::CConfigFileMemory config("[perception]\n" + line + "\n");
  PerceptionOptions options;
  options.loadFromConfigFile(config, "perception");
  return options;
}

TEST(PerceptionOptions, ReadsEveryKey)
{
  EXPECT_EQ(read("minRange = 0.5").minRange, 0.5);
  EXPECT_EQ(read("maxRange = 4").maxRange, 4.0);
  EXPECT_EQ(read("depthSigmaFloor = 0.002").depthNoise.floor, 0.002);
  EXPECT_EQ(read("depthSigmaGrowth = 0.003").depthNoise.growth, 0.003);
  EXPECT_EQ(read("maxDepthNoiseFactor = 2").maxDepthNoiseFactor, 2.0);
  EXPECT_EQ(read("planeMinArea = 0.02").planeMinArea, 0.02);
  EXPECT_NEAR(read("planeMaxTilt_deg = 5").planeMaxTilt, 5 * M_PI / 180, 1e-12);
  EXPECT_EQ(read("planeTolerance = 0.02").planeTolerance, 0.02);
  EXPECT_EQ(read("boxMargin = 0.1").boxMargin, 0.1);
  EXPECT_EQ(read("clusterTolerance = 0.05").clusterTolerance, 0.05);
  EXPECT_EQ(read("clusterToleranceGrowth = 0.02").clusterToleranceGrowth, 0.02);
  EXPECT_EQ(read("minPoints = 80").minPoints, 80);
  EXPECT_EQ(read("yawMinDominance = 0.5").yawMinDominance, 0.5);
  EXPECT_EQ(read("minCompleteIoU = 0.6").minCompleteIoU, 0.6);
  EXPECT_EQ(read("minDepthCoverage = 0.4").minDepthCoverage, 0.4);
  EXPECT_EQ(read("borderMargin = 20").borderMargin, 20.0);
  EXPECT_EQ(read("occlusionStrip = 10").occlusionStrip, 10.0);
  EXPECT_EQ(read("maxHiddenProbability = 0.4").maxHiddenProbability, 0.4);
  EXPECT_EQ(read("edgeTolerance = 5").edgeTolerance, 5.0);
  EXPECT_EQ(read("edgeSigma = 3").edgeSigma, 3.0);
  EXPECT_EQ(read("edgeSigmaShare = 0.02").edgeSigmaShare, 0.02);
  EXPECT_EQ(read("models = both").models, ObservationModels::Both);
  EXPECT_EQ(read("models = complete").models, ObservationModels::Complete);
  EXPECT_EQ(read("models = partial").models, ObservationModels::Partial);
}

TEST(PerceptionOptions, RefusesWhatItDoesNotUnderstand)
{
  for (const char* line :
       {"maxRnge = 4", "maxRange = 4m", "maxRange = -1", "minPoints = 2", "minCompleteIoU = 1.5",
        "minRange = 7", "maxDepthNoiseFactor = 0.5", "models = some"})
    EXPECT_THROW(read(line), std::invalid_argument) << line;
}

TEST(PerceptionOptions, SavesWhatItReads)
{
  PerceptionOptions options;
  options.maxRange = 3.25;
  options.minPoints = 77;
  options.models = ObservationModels::Partial;
  mrpt::config::CConfigFileMemory config;
  options.saveToConfigFile(config, "perception");
  std::string text;
  config.getContent(text);
  mrpt::config::CConfigFileMemory again(text);
  PerceptionOptions copy;
  copy.loadFromConfigFile(again, "perception");
  EXPECT_EQ(copy.maxRange, 3.25);
  EXPECT_EQ(copy.minPoints, 77);
  EXPECT_EQ(copy.models, ObservationModels::Partial);
}

TEST(PerceptionOptions, ModelDepthNoiseAsPublished)
{
  // Nguyen et al. 2012: 1.2 mm at 0.4 m, about 6 mm at 2 m, 14 mm at 3 m.
  const PerceptionOptions options;
  EXPECT_NEAR(options.depthSigma(0.4), 0.0012, 1e-6);
  EXPECT_NEAR(options.depthSigma(2.0), 0.0061, 2e-4);
  EXPECT_NEAR(options.depthSigma(3.0), 0.0140, 2e-4);
}

}  // namespace
}  // namespace quadmap
