#include "quadmap/slam/SlamConfiguration.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFile.h>

#include <cmath>

#include "../../obs/TemporaryFolder.h"

using namespace quadmap;

namespace
{
const std::string kShared = QUADMAP_SOURCE_DIR "/share/quadmap/quadmap.ini";

using Values = std::map<std::string, std::string>;

/** Values by "[section] key". */
Values valuesOf(const mrpt::config::CConfigFileBase& config)
{
  Values values;
  std::vector<std::string> sections, keys;
  config.getAllSections(sections);
  for (const auto& section : sections)
  {
    config.getAllKeys(section, keys);
    for (const auto& key : keys)
      values["[" + section + "] " + key] = config.read_string(section, key, "");
  }
  return values;
}

std::string errorFor(const std::string& ini)
{
  const TemporaryFolder folder;
  const auto path = folder.write("x.ini", ini);
  const std::string error = errorOf([&] { SlamConfiguration::fromFile(path); });
  EXPECT_EQ(error.find(path), error.empty() ? std::string::npos : 0) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  return error.empty() ? "" : error.substr(path.size());
}
}  // namespace

TEST(SlamConfiguration, SharedFileListsEveryOptionWithItsDefault)
{
  const mrpt::config::CConfigFile file(kShared);
  const Values listed = valuesOf(file);
  const Values defaults = valuesOf(SlamConfiguration().toConfig());
  for (const auto& [key, value] : defaults)
  {
    ASSERT_EQ(listed.count(key), 1u) << key << " is not in " << kShared;
    EXPECT_EQ(listed.at(key), value) << key;
  }
  EXPECT_EQ(listed.size(), defaults.size()) << "options in the file that do not exist";
}

TEST(SlamConfiguration, SharedFileIsAccepted)
{
  const Values read = valuesOf(SlamConfiguration::fromFile(kShared).toConfig());
  for (const auto& [key, value] : valuesOf(SlamConfiguration().toConfig()))
    EXPECT_EQ(read.at(key), value) << key;
}

TEST(SlamConfiguration, EverySectionIsRead)
{
  const TemporaryFolder folder;
  const auto path = folder.write(
      "x.ini",
      "[slam]\nmethod=odometry\nodometry=ground-truth\n[input]\nmaxBoxDelay=0.02\n"
      "maxOdometryGap=2.5\n[keyframes]\nevery=7\nminTranslation=0.3\nminRotation_deg=90\n"
      "maxInterval=4\n[poses]\nsigmaPosition=0.01\nsigmaAngle_deg=180\n"
      "sigmaPositionPerMetre=0.1\nsigmaAnglePerRadian=0.2\nsigmaAnglePerMetre=0.3\n"
      "[visual]\nfeatures=300\nkeyframeRotation_deg=9\nmaxGap=2\n[perception]\nminPoints=99\n["
      "CQuadricObjectMap_insertOpts]\nalpha=0.7\n"
      "[CQuadricObjectMap_likelihoodOpts]\noutlierShare=0.3\n"
      "[CQuadricObjectMap_renderOpts]\nopacity=0.9\n");
  const auto c = SlamConfiguration::fromFile(path);
  EXPECT_EQ(c.slam.method, SlamMethod::Odometry);
  EXPECT_EQ(c.slam.odometry, PoseSource::GroundTruth);
  EXPECT_EQ(c.input.maxBoxDelay, 0.02);
  EXPECT_EQ(c.input.maxOdometryGap, 2.5);
  EXPECT_EQ(c.keyframes.every, 7);
  EXPECT_EQ(c.keyframes.minTranslation, 0.3);
  EXPECT_NEAR(c.keyframes.minRotation, M_PI / 2, 1e-12);
  EXPECT_EQ(c.keyframes.maxInterval, 4);
  EXPECT_EQ(c.poses.sigmaPosition, 0.01);
  EXPECT_NEAR(c.poses.sigmaAngle, M_PI, 1e-12);
  EXPECT_EQ(c.poses.sigmaPositionPerMetre, 0.1);
  EXPECT_EQ(c.poses.sigmaAnglePerRadian, 0.2);
  EXPECT_EQ(c.poses.sigmaAnglePerMetre, 0.3);
  EXPECT_EQ(c.visual.features, 300);
  EXPECT_NEAR(c.visual.keyframeRotation, M_PI / 20, 1e-12);
  EXPECT_EQ(c.visual.maxGap, 2);
  EXPECT_EQ(c.perception.minPoints, 99);
  EXPECT_EQ(c.mapInsertion.association.alpha, 0.7);
  EXPECT_EQ(c.mapLikelihood.outlierShare, 0.3);
  EXPECT_EQ(c.mapRender.opacity, 0.9);
}

TEST(SlamConfiguration, EveryMethodAndPoseSourceHasAName)
{
  for (const auto method :
       {SlamMethod::Rgbd, SlamMethod::Quadric, SlamMethod::Point, SlamMethod::Odometry})
    EXPECT_EQ(slamMethodFrom(nameOf(method)), method);
  for (const auto source :
       {PoseSource::Auto, PoseSource::Rawlog, PoseSource::Visual, PoseSource::GroundTruth,
        PoseSource::Graph})
    EXPECT_EQ(poseSourceFrom(nameOf(source)), source);
  for (const auto source : {AssociationSource::Estimated, AssociationSource::Given})
    EXPECT_EQ(associationSourceFrom(nameOf(source)), source);
}

TEST(SlamConfiguration, RejectsWhatItDoesNotKnow)
{
  const struct
  {
    const char *ini, *error;
  } cases[] = {
      {                   "[slamm]\nmethod=rgbd\n",": unknown section [slamm]; known: slam, "                                                   },
      {                     "[slam]\nmetod=rgbd\n",                   ": [slam] unknown key \"metod\""},
      {                   "[slam]\nmethod=magic\n",     ": [slam] method=magic: must be one of rgbd, "},
      {                  "[slam]\nodometry=none\n",
       ": [slam] odometry=none: must be one of auto, rawlog, visual, ground-truth, graph:FILE"        },
      {                "[input]\nmaxBoxDelay=-1\n",                  "[input] maxBoxDelay=-1: must be"},
      {              "[input]\nmaxOdometryGap=0\n",                "[input] maxOdometryGap=0: must be"},
      {                 "[keyframes]\nevery=2.5\n",    "[keyframes] every=2.5: must be a whole number"},
      {                  "[keyframes]\nevery=-1\n",                    "[keyframes] every=-1: must be"},
      {        "[keyframes]\nminTranslation=5cm\n", "[keyframes] minTranslation=5cm: must be a number"},
      {           "[keyframes]\nminRotation=0.1\n",          "[keyframes] unknown key \"minRotation\""},
      {           "[keyframes]\nmaxInterval=nan\n",             "[keyframes] maxInterval=nan: must be"},
      {               "[poses]\nsigmaPosition=0\n",                 "[poses] sigmaPosition=0: must be"},
      {               "[poses]\nsigmaAngle_deg=\n",                 "[poses] sigmaAngle_deg=: must be"},
      {                   "[visual]\nfeatures=5\n",                     "[visual] features=5: must be"},
      {                 "[visual]\nmaxRange=0.2\n",  "[visual] maxRange=0.2: must be > minRange (0.3)"},
      {             "[perception]\nmaxRange=far\n",               "[perception] maxRange=far: must be"},
      {"[CQuadricObjectMap_insertOpts]\nalpha=0\n",                                 "alpha=0: must be"},
      { "[CQuadricObjectMap_creationOpts]\n x=0\n",                                  "unknown section"},
      {                            "method=rgbd\n",                                                 ""},
      {                         "[slam]\nmethod\n",                                     ":2: expected"},
  };
  for (const auto& c : cases)
  {
    const std::string error = errorFor(c.ini);
    EXPECT_FALSE(error.empty()) << c.ini;
    EXPECT_NE(error.find(c.error), std::string::npos) << c.ini << " gave " << error;
  }
  const std::string missing = "/nonexistent/x.ini";
  EXPECT_EQ(errorOf([&] { SlamConfiguration::fromFile(missing); }).find(missing), 0u);
}
