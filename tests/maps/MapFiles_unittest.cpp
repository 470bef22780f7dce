#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cstdlib>
#include <thread>

#include "../obs/TemporaryFolder.h"
#include "ObjectMapFixture.h"
#include "quadmap/base/GzipStream.h"
#include "quadmap/maps/MapFile.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

namespace
{
std::string gzipped(const std::string& bytes)
{
  const auto member = gzipMember({bytes.begin(), bytes.end()}, 6);
  return {member.begin(), member.end()};
}

std::string archiveOf(const mrpt::serialization::CSerializable& object)
{
  const auto bytes = archiveBytes(object);
  return {bytes.begin(), bytes.end()};
}

/** A table that no program installs. */
const char* const kGizmos = "[gizmo]\naliases = thingamajig\ntypicalSize = 0.7 0.4 0.6\n";

CQuadricObjectMap mapOfGizmo(const TemporaryFolder& folder)
{
  CQuadricObjectMap map;
  map.setLabels(LabelTable::fromFile(folder.write("gizmos.ini", kGizmos)));
  SyntheticCamera camera(4);
  walkAround(map, camera, {cuboid("thingamajig", {0, 0, 0.3}, {0.7, 0.4, 0.6}, 0.4)}, 12);
  map.consolidate();
  return map;
}

}  // namespace

TEST(MapFiles, ReadsArchiveVersionZero)
{
  CQuadricObjectMap map;
  map.loadFromFile(QUADMAP_SOURCE_DIR "/tests/maps/data/home-archive-version-0.quadmap");
  EXPECT_EQ(map.objects().size(), 17u);
  const auto confirmed = map.confirmedObjects();
  ASSERT_EQ(confirmed.size(), 16u);
  for (std::size_t i = 0; i < confirmed.size(); ++i) EXPECT_EQ(confirmed[i]->id, i + 1);

  // From the objects.json of the same run
  const MapObject& chair = *map.find(2);
  EXPECT_EQ(
      chair.labelCounts, (std::map<std::string, unsigned>{
                             {"bench",  2},
                             {"chair", 66},
                             {"couch",  1}
  }));
  EXPECT_EQ(chair.observations(), 69u);
  EXPECT_NEAR(chair.existenceLogOdds, 10, 1e-9);
  EXPECT_GT(chair.sizeLogOdds, 1) << "archives hold no evidence of sizes, it is weighed anew";
  EXPECT_NEAR(chair.covariance(0, 0), 1.5700334516038793e-05, 1e-15);
  const Eigen::Vector3d center(0.6187274808786561, -0.7479527411719227, 0.44131296558033606);
  const Eigen::Vector3d size(0.463850763628054, 0.46095516975434186, 0.9209850918509315);
  EXPECT_LT((chair.object.center() - center).norm(), 1e-12);
  EXPECT_LT((2 * chair.object.semiAxes() - size).norm(), 1e-12);
  EXPECT_EQ(map.find(13)->label(), "tv");
  EXPECT_EQ(map.find(13)->observations(), 26u);
  EXPECT_EQ(map.withLabel("chair").size(), 4u);
  EXPECT_FALSE(map.find(17) && map.find(17)->confirmed);

  // It can be carried on, and is written in the version of today.
  map.consolidate();
  EXPECT_LT((map.find(2)->object.center() - center).norm(), 1e-3);
  const TemporaryFolder folder;
  map.saveToFile(folder.path("today.quadmap"));
  CQuadricObjectMap again;
  again.loadFromFile(folder.path("today.quadmap"));
  EXPECT_EQ(again.find(2)->labelCounts, chair.labelCounts);
}

TEST(MapFiles, SavedMapReadsBack)
{
  const TemporaryFolder folder;
  const CQuadricObjectMap map = smallMap();
  map.saveToFile(folder.path("a.quadmap"));
  EXPECT_EQ(folder.fileCount(), 1u) << "no temporary file is left";
  CQuadricObjectMap loaded;
  SyntheticCamera camera(5);
  walkAround(loaded, camera, {cuboid("cup", {0, 0, 0.8}, {0.1, 0.1, 0.1}, 0)}, 6);
  loaded.loadFromFile(folder.path("a.quadmap"));
  EXPECT_EQ(archiveOf(loaded), archiveOf(map)) << "nothing of the map before is left";
  const auto error = errorOf([&] { map.saveToFile("/nowhere/a.quadmap"); });
  EXPECT_NE(error.find("/nowhere/a.quadmap"), std::string::npos) << error;
}

TEST(MapFiles, AnAbsurdObjectIsNotRead)
{
  const TemporaryFolder folder;
  CQuadricObjectMap map = smallMap();
  const MapObject& object = *map.confirmedObjects().at(0);
  const double x = object.object.center().x(), far = 1e300;
  std::string bytes = archiveOf(map);
  const auto at = bytes.find(std::string(reinterpret_cast<const char*>(&x), sizeof x));
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, sizeof far, reinterpret_cast<const char*>(&far), sizeof far);
  const auto path = folder.write("a.quadmap", gzipped(bytes));
  const auto error = errorOf([&] { map.loadFromFile(path); });
  EXPECT_NE(error.find("a.quadmap: "), std::string::npos) << error;
  EXPECT_NE(error.find("an object is 1e+300 m away"), std::string::npos) << error;

  const auto refused = [&](const CPose3D& pose, double halfSize)
  {
    const Ellipsoid place(pose, Eigen::Vector3d::Constant(halfSize));
    return errorOf([&] { map.place(object.id, place); });
  };
  EXPECT_EQ(
      refused(CPose3D(1e300, 0, 0, 0, 0, 0), 1),
      "an object of the map is 1e+300 m away, which is absurd");
  EXPECT_NE(refused(CPose3D(), 1e300).find("has a size that is"), std::string::npos);
}

TEST(MapFiles, AnObjectThatItsMeasurementsContradictIsNotRead)
{
  const TemporaryFolder folder;
  CQuadricObjectMap map = smallMap();
  const MapObject& object = *map.confirmedObjects().at(0);
  const UprightState x = uprightStateOf(object.object);
  const auto as8 = [](const double& number)
  { return std::string(reinterpret_cast<const char*>(&number), sizeof number); };
  const auto errorWith = [&](std::size_t after, double before, double edited)
  {
    std::string bytes = archiveOf(map);
    const auto at = bytes.find(as8(before), after);
    if (at == std::string::npos) return std::string("has no such number");
    bytes.replace(at, sizeof edited, as8(edited));
    return errorOf([&] { map.loadFromFile(folder.write("a.quadmap", gzipped(bytes))); });
  };
  const std::size_t begin = archiveOf(map).find(as8(x[0]));
  EXPECT_NE(
      errorWith(begin, x[2], 424).find(" m away from where its measurements have it"),
      std::string::npos);
  EXPECT_NE(errorWith(begin, x[4], -13).find("another size than its"), std::string::npos);
  EXPECT_EQ(errorWith(begin, x[2], x[2] + 0.5), "") << "as good as a correction by hand";
}

TEST(MapFiles, OptionsThatMrptWouldRunAreNotRead)
{
  const TemporaryFolder folder;
  CQuadricObjectMap map = smallMap();
  std::string bytes = archiveOf(map);
  const auto line = bytes.find("alpha");
  ASSERT_NE(line, std::string::npos);
  const std::string loop = "a=$eval{repeat 1 until(0)}";
  bytes.replace(line, loop.size(), loop);
  const auto path = folder.write("a.quadmap", gzipped(bytes));
  const auto error = errorOf([&] { map.loadFromFile(path); });
  EXPECT_NE(error.find("a.quadmap: "), std::string::npos) << error;
  EXPECT_NE(error.find("its options:"), std::string::npos) << error;
}

TEST(MapFiles, WhatGoesWrongWithAFrameNamesItsFile)
{
  const TemporaryFolder folder;
  auto boxes = mrpt::obs::CObservation::Ptr(std::make_shared<CObservationObjects>());
  mrpt::obs::CSensoryFrame frame;
  frame.insert(boxes);
  mrpt::maps::CSimpleMap keyframes;
  keyframes.insert(mrpt::poses::CPose3DPDFGaussian(), frame);
  keyframes.saveToFile(folder.path("objects.simplemap"));
  const auto frames = framesOf(folder.path("objects.simplemap"));
  ASSERT_TRUE(frames);
  try
  {
    frames([](const auto&, const auto&) { throw std::invalid_argument("does not fit"); });
    FAIL();
  }
  catch (const std::runtime_error& e)
  {
    EXPECT_EQ(e.what(), folder.path("objects.simplemap") + ": does not fit");
  }
}

TEST(MapFiles, KeepTheirLabelTable)
{
  const TemporaryFolder folder;
  mapOfGizmo(folder).saveToFile(folder.path("gizmo.quadmap"));
  CQuadricObjectMap loaded;
  loaded.loadFromFile(folder.path("gizmo.quadmap"));
  ASSERT_EQ(loaded.confirmedObjects().size(), 1u) << loaded.asString();
  EXPECT_EQ(loaded.confirmedObjects()[0]->label(), "gizmo");
  EXPECT_EQ(loaded.withLabel("Thingamajig_2").size(), 1u);
  EXPECT_EQ(loaded.labels().all().size(), 1u);

  CQuadricObjectMap empty, given;
  empty.saveToFile(folder.path("empty.quadmap"));
  given.setLabels(LabelTable::fromFile(folder.path("gizmos.ini")));
  given.loadFromFile(folder.path("empty.quadmap"));
  EXPECT_TRUE(given.labels().properties("chair").known) << "a map without table: the installed one";
}

TEST(MapFiles, RefuseWhatIsNoWholeMap)
{
  const TemporaryFolder folder;
  const CQuadricObjectMap map = smallMap();
  const std::string bytes = archiveOf(map), file = gzipped(bytes);
  std::string newer = bytes;
  const std::string name = "quadmap::CQuadricObjectMap";
  newer.at(newer.find(name) + name.size()) = 77;

  std::map<std::string, std::string> wrong{
      {                                                "",             "is no object map"},
      {                                 "no map at all\n",             "is no object map"},
      {                                    gzipped(newer),                "newer version"},
      {gzipped(archiveOf(mrpt::maps::CSimplePointsMap())), "mrpt::maps::CSimplePointsMap"}
  };
  for (const double share : {0.05, 0.5, 0.9, 0.999})
  {
    const auto kept = static_cast<std::size_t>(share * static_cast<double>(file.size()));
    wrong[file.substr(0, kept)] = "truncated";
    wrong[bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size())))] =
        "truncated";
  }
  wrong[file.substr(0, file.size() - 1)] = "truncated";  // all of the archive is there
  for (const std::string& more : {file, std::string("\n"), std::string(512, '\0')})
  {
    wrong[file + more] = more == file ? "follow the map" : "follows";
    wrong[bytes + more] = "follow the map";
  }
  for (std::size_t at = 20; at < file.size(); at += file.size() / 40)
  {
    std::string flipped = file;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x10);
    wrong[flipped] = "";
  }
  CQuadricObjectMap loaded = map;
  for (const auto& [content, expected] : wrong)
  {
    const std::string path = folder.write("x.quadmap", content);
    const auto error = errorOf([&] { loaded.loadFromFile(path); });
    EXPECT_EQ(error.rfind(path + ": ", 0), 0u) << error;
    EXPECT_NE(error.find(expected), std::string::npos) << error << " of " << content.size();
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    EXPECT_EQ(loaded.objects().size(), map.objects().size()) << "the map is as it was";
  }
  for (const std::string& path : {folder.path("missing.quadmap"), folder.folder().string()})
    EXPECT_EQ(errorOf([&] { loaded.loadFromFile(path); }), path + ": cannot be read");
}

TEST(MapLabels, AreReadWhenTheyAreNeeded)
{
  const TemporaryFolder folder;
  folder.write("labels.ini", "[chair]\nshapeExponent = 7\n");
  ASSERT_EQ(::setenv("QUADMAP_SHARE_DIR", folder.folder().c_str(), 1), 0);
  const CQuadricObjectMap map;
  const CQuadricObjectMap copy = map;
  EXPECT_TRUE(copy.isEmpty());
  EXPECT_FALSE(archiveOf(copy).empty());
  const auto error = errorOf([&] { map.labels(); });
  ASSERT_EQ(::unsetenv("QUADMAP_SHARE_DIR"), 0);
  EXPECT_NE(error.find("labels.ini"), std::string::npos) << error;
  EXPECT_TRUE(map.labels().properties("chair").known) << "after the fault was mended";
}

TEST(MapLabels, ManyThreadsMayAskFirst)
{
  for (int round = 0; round < 5; ++round)
  {
    const CQuadricObjectMap map;
    std::vector<const LabelTable*> tables(4);
    std::vector<std::thread> threads;
    for (auto& table : tables)
      threads.emplace_back(
          [&table, &map]
          {
            if (map.labels().properties("chair").known) table = &map.labels();
          });
    for (auto& thread : threads) thread.join();
    for (const auto* table : tables) EXPECT_EQ(table, &map.labels());
  }
}
