#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>

#include "../maps/SyntheticScene.h"
#include "../obs/TemporaryFolder.h"
#include "Fuzz.h"
#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/slam/SlamConfiguration.h"

using namespace quadmap;

namespace
{
std::string archiveBytes(const CQuadricObjectMap& map)
{
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << map;
  return std::string(
      static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount());
}

/** Two pieces of furniture, seen while walking around them. */
CQuadricObjectMap filledMap()
{
  const std::vector<quadmap::testing::TrueObject> world = {
      quadmap::testing::cuboid("suitcase", {0, 0, 0.3}, {0.8, 0.45, 0.6}, 0.3),
      quadmap::testing::cuboid("chair", {0.3, 1.4, 0.45}, {0.5, 0.5, 0.9}, -0.2)};
  quadmap::testing::SyntheticCamera camera(1);
  CQuadricObjectMap map;
  for (int i = 0; i < 12; ++i)
  {
    const double angle = 0.4 * i;
    const auto pose = quadmap::testing::SyntheticCamera::lookAt(
        {3 * std::cos(angle), 0.7 + 3 * std::sin(angle), 1.3}, {0.1, 0.7, 0.4});
    map.insertObservation(camera.observe(pose, world), pose);
  }
  map.consolidate();
  return map;
}

/** Everything one does with a freshly read map must work, too. */
void use(CQuadricObjectMap& map)
{
  map.asString();
  map.toRecords();
  for (const auto* object : map.confirmedObjects()) map.footprint(object->id);
  mrpt::opengl::CSetOfObjects scene;
  map.getVisualizationInto(scene);
  quadmap::testing::SyntheticCamera camera(2);
  const auto pose = quadmap::testing::SyntheticCamera::lookAt({3, 0, 1.3}, {0, 0, 0.4});
  const auto seen = camera.observe(
      pose, {quadmap::testing::cuboid("suitcase", {0, 0, 0.3}, {0.8, 0.45, 0.6}, 0.3)});
  map.computeObservationLikelihood(seen, pose);
  map.insertObservation(seen, pose);
  map.consolidate();
  archiveBytes(map);
}
}  // namespace

TEST(Fuzz, MapArchive)
{
  const auto map = filledMap();
  ASSERT_FALSE(map.objects().empty());
  FuzzRun run;
  run.words = {"minViews", "\n[x]\n"};
  fuzz(
      archiveBytes(map), run,
      [](const std::string& bytes)
      {
        mrpt::io::CMemoryStream stream(bytes.data(), bytes.size());
        auto archive = mrpt::serialization::archiveFrom(stream);
        CQuadricObjectMap copy;
        archive >> copy;
        use(copy);
      });
}

TEST(Fuzz, SlamConfiguration)
{
  const TemporaryFolder folder;
  FuzzRun run;
  run.words = {"[slam]", "[input]", "[]", "= yes", "${", "@define"};
  fuzz(
      SlamConfiguration().toConfig().getContent(), run,
      [&](const std::string& text)
      { SlamConfiguration::fromFile(folder.write("quadmap.ini", text)).toConfig(); });
}
