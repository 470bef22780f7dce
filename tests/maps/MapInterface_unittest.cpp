#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <sstream>

#include "../obs/TemporaryFolder.h"
#include "ObjectMapFixture.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::serialization::archiveFrom;

namespace
{
void expectSame(const CQuadricObjectMap& a, const CQuadricObjectMap& b)
{
  ASSERT_EQ(a.objects().size(), b.objects().size());
  for (const auto& [id, x] : a.objects())
  {
    const MapObject* y = b.find(id);
    ASSERT_TRUE(y);
    EXPECT_LT((uprightStateOf(x.object) - uprightStateOf(y->object)).norm(), 1e-12);
    EXPECT_LT((x.covariance - y->covariance).norm(), 1e-12);
    EXPECT_EQ(x.labelCounts, y->labelCounts);
    EXPECT_EQ(x.completeCount, y->completeCount);
    EXPECT_EQ(x.partialCount, y->partialCount);
    EXPECT_EQ(x.missCount, y->missCount);
    EXPECT_EQ(x.orientationDefined, y->orientationDefined);
    EXPECT_NEAR(x.logOdds(), y->logOdds(), 1e-9);
    EXPECT_EQ(x.confirmed, y->confirmed);
    EXPECT_EQ(x.firstSeen, y->firstSeen);
    EXPECT_EQ(x.lastSeen, y->lastSeen);
  }
}

mrpt::maps::CMultiMetricMap multiMapFrom(const std::string& ini)
{
  registerMapClasses();
  mrpt::maps::TSetOfMetricMapInitializers definitions;
  definitions.loadFromConfigFile(mrpt::config::CConfigFileMemory(ini), "map");
  mrpt::maps::CMultiMetricMap maps;
  maps.setListOfMaps(definitions);
  return maps;
}

}  // namespace

// Serialization --------------------------------------------------------------------------------

TEST(MapArchive, RoundTripsAndContinues)
{
  CQuadricObjectMap map = smallMap();
  map.insertionOptions.estimator.huber = 1.25;
  map.likelihoodOptions.outlierShare = 0.2;
  map.renderOptions.labels = false;
  map.genericMapParams.enableSaveAs3DObject = false;
  mrpt::io::CMemoryStream stream;
  archiveFrom(stream) << map;
  stream.Seek(0);
  CQuadricObjectMap loaded;
  archiveFrom(stream) >> loaded;
  expectSame(map, loaded);
  EXPECT_EQ(loaded.insertionOptions.estimator.huber, 1.25);
  EXPECT_EQ(loaded.likelihoodOptions.outlierShare, 0.2);
  EXPECT_FALSE(loaded.renderOptions.labels);
  EXPECT_FALSE(loaded.genericMapParams.enableSaveAs3DObject);

  // More of the same must change neither much: the loaded map knows what it has seen.
  const std::vector<TrueObject> world = {cuboid("suitcase", {0, 0, 0.3}, {0.7, 0.4, 0.6}, 0.4)};
  SyntheticCamera camera(1), sameCamera(1);
  walkAround(map, camera, world, 6);
  walkAround(loaded, sameCamera, world, 6);
  map.consolidate();
  loaded.consolidate();
  ASSERT_EQ(map.objects().size(), loaded.objects().size());
  const auto* a = map.nearest({0, 0, 0.3}, "suitcase");
  const auto* b = loaded.nearest({0, 0, 0.3}, "suitcase");
  ASSERT_TRUE(a && b);
  EXPECT_LT((a->object.center() - b->object.center()).norm(), 0.005);
  EXPECT_NEAR(std::sqrt(b->covariance(0, 0) / a->covariance(0, 0)), 1.0, 0.2);
}

TEST(MapArchive, RoundTripsThroughGzInsideAMultiMetricMap)
{
  auto maps = multiMapFrom("[map]\nCQuadricObjectMap_count=1\n");
  auto& map = dynamic_cast<CQuadricObjectMap&>(*maps.maps.at(0));
  map = smallMap();
  const TemporaryFolder folder;
  const std::string file = folder.path("maps.gz");
  {
    mrpt::io::CFileGZOutputStream out(file);
    archiveFrom(out) << maps;
  }
  mrpt::maps::CMultiMetricMap loaded;
  mrpt::io::CFileGZInputStream in(file);
  archiveFrom(in) >> loaded;
  ASSERT_EQ(loaded.maps.size(), 1u);
  expectSame(map, dynamic_cast<const CQuadricObjectMap&>(*loaded.maps.at(0)));
}

TEST(MapArchive, DamagedFilesThrow)
{
  mrpt::io::CMemoryStream whole;
  archiveFrom(whole) << smallMap();
  const auto* bytes = static_cast<const char*>(whole.getRawBufferData());
  const auto size = whole.getTotalBytesCount();
  for (const double share : {0.1, 0.5, 0.9, 0.99})
  {
    const auto kept = static_cast<std::uint64_t>(share * static_cast<double>(size));
    mrpt::io::CMemoryStream cut(bytes, kept);
    CQuadricObjectMap map;
    EXPECT_ANY_THROW(archiveFrom(cut) >> map) << share;
    EXPECT_TRUE(map.isEmpty()) << "half a map is none";
  }
  // The version is the byte after the class's name.
  std::string changed(bytes, size);
  const std::string name = "quadmap::CQuadricObjectMap";
  const auto version = changed.find(name) + name.size();
  ASSERT_EQ(changed[version], 1);
  changed[version] = 77;
  mrpt::io::CMemoryStream unknown(changed.data(), size);
  CQuadricObjectMap map;
  EXPECT_ANY_THROW(archiveFrom(unknown) >> map);
}

TEST(MapArchive, CopiesAreIndependent)
{
  CQuadricObjectMap map = smallMap();
  const std::shared_ptr<mrpt::rtti::CObject> clone(map.clone());
  const auto& copy = dynamic_cast<const CQuadricObjectMap&>(*clone);
  expectSame(map, copy);
  map.clear();
  EXPECT_TRUE(map.isEmpty());
  EXPECT_FALSE(copy.isEmpty());
}

// Creation -------------------------------------------------------------------------------------

TEST(MapDefinition, ValuesArriveFromIniUnderBothNames)
{
  for (const std::string name : {"CQuadricObjectMap", "quadricObjectMap"})
  {
    const auto maps = multiMapFrom(
        "[map]\n" + name + "_count=1\n[map_" + name + "_00_insertOpts]\nalpha=0.25\n" +
        "maxMeasurementsPerObject=33\nposeAngleSigma_deg=2\nuseInstanceIds=yes\n[map_" + name +
        "_00_likelihoodOpts]\npositionSigma=0.4\n[map_" + name +
        "_00_renderOpts]\nopacity=0.7\n[map_" + name +
        "_00_creationOpts]\nenableObservationInsertion=false\n");
    ASSERT_EQ(maps.maps.size(), 1u) << name;
    const auto& map = dynamic_cast<const CQuadricObjectMap&>(*maps.maps.at(0));
    EXPECT_EQ(map.insertionOptions.association.alpha, 0.25);
    EXPECT_EQ(map.insertionOptions.estimator.maxMeasurements, 33);
    EXPECT_NEAR(map.insertionOptions.poseNoise.angle, 2 * M_PI / 180, 1e-12);
    EXPECT_TRUE(map.insertionOptions.useInstanceIds);
    EXPECT_EQ(map.likelihoodOptions.positionSigma, 0.4);
    EXPECT_EQ(map.renderOptions.opacity, 0.7);
    EXPECT_FALSE(map.genericMapParams.enableObservationInsertion);
  }
}

TEST(MapDefinition, MistakesInTheIniAreErrors)
{
  for (const std::string wrong :
       {"insertOpts]\nalhpa=1", "insertOpts]\nalpha=-1", "insertOpts]\nalpha=ten",
        "insertOpts]\nmaxIterations=4abc", "insertOpts]\nuseInstanceIds=yess",
        "insertOpts]\ndetectionProbability=0.05", "likelihoodOpts]\noutlierShare=2",
        "renderOpts]\nopaqueness=1", "creationOpts]\nlabels=x",
        "creationOpts]\nlabelTable=/nowhere/labels.ini", "perceptionOpts]\nmaxRnage=3",
        "insertionOpts]\nalpha=1", "]\nalpha=1", "creationOpt]\n"})
    EXPECT_ANY_THROW(
        multiMapFrom("[map]\nCQuadricObjectMap_count=1\n[map_CQuadricObjectMap_00_" + wrong + "\n"))
        << wrong;
}

TEST(MapDefinition, SharesOfRepeatedErrorsMayBeEqual)
{
  InsertionOptions options;
  using Memory = mrpt::config::CConfigFileMemory;
  options.loadFromConfigFile(Memory("[x]\nrepeatedAnywhere=0.5\nrepeatedThere=0.5\n"), "x");
  EXPECT_EQ(options.estimator.repeatedAnywhere, 0.5);
  EXPECT_THROW(
      options.loadFromConfigFile(Memory("[x]\nrepeatedAnywhere=0.6\nrepeatedThere=0.5\n"), "x"),
      std::invalid_argument);
}

TEST(MapDefinition, SavedOptionsReadBackExactly)
{
  InsertionOptions a;
  a.association.newObjectVolume = 1.0 / 3.0;
  a.agreement.imageWeight = 0.1234567890123;
  a.poseNoise.angle = 0.0123;
  mrpt::config::CConfigFileMemory out;
  a.saveToConfigFile(out, "x");
  InsertionOptions b;
  b.loadFromConfigFile(mrpt::config::CConfigFileMemory(out.getContent()), "x");
  EXPECT_EQ(b.association.newObjectVolume, 1.0 / 3.0);
  EXPECT_EQ(b.agreement.imageWeight, 0.1234567890123);
  EXPECT_EQ(b.poseNoise.angle, 0.0123);
  std::ostringstream text;
  b.dumpToTextStream(text);
  EXPECT_NE(text.str().find("newObjectVolume"), std::string::npos);
}
