#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "RunProgram.h"
#include "SampleMap.h"
#include "quadmap/base/Sha256.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
const CPose3D kOther(1.5, -0.7, 0.1, 2.1, 0, 0);  // T_own_other

/** The sample and `more` as another robot maps them: in its own frame, 1,000 s later. Views of
 * labels in `without` are left out. */
mrpt::maps::CSimpleMap otherSession(
    const std::string& without = "", const std::vector<quadmap::testing::TrueObject>& more = {})
{
  mrpt::maps::CSimpleMap keyframes;
  forEachViewOfSample(
      [&](const auto& T_map_sensor, const CObservationObjects& seen)
      {
        auto boxes = std::make_shared<CObservationObjects>(seen);
        boxes->timestamp += std::chrono::seconds(1000);
        auto& list = boxes->objects;
        list.erase(
            std::remove_if(
                list.begin(), list.end(), [&](const auto& box) { return box.label == without; }),
            list.end());
        mrpt::obs::CSensoryFrame frame;
        frame.insert(boxes);
        keyframes.insert(mrpt::poses::CPose3DPDFGaussian(-kOther + CPose3D(T_map_sensor)), frame);
      },
      more);
  return keyframes;
}

class QuadmapMapMerge : public ::testing::Test
{
 protected:
  QuadmapMapMerge()
  {
    sampleMap().saveToFile(folder_.path("own.quadmap"));
    otherSession().saveToFile(folder_.path("other.simplemap"));
  }

  /** Arguments in which @ stands for the folder. */
  ProgramResult run(const std::string& arguments) const
  {
    return runProgram("quadmap-map", "merge " + replaced(arguments, "@", folder_.path("")));
  }

  nlohmann::json report(const std::string& name) const
  {
    return nlohmann::json::parse(readFile(folder_.path(name)));
  }

  TemporaryFolder folder_;
};
}  // namespace

TEST_F(QuadmapMapMerge, MakesOneMapOfTwoAndSaysWhereItCameFrom)
{
  const std::string before = readFile(folder_.path("own.quadmap"));
  const auto result = run("@own.quadmap @other.simplemap -o @both.quadmap");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(readFile(folder_.path("own.quadmap")) == before) << "a merge is undone by file";
  const auto both = mapFrom(folder_.path("both.quadmap")),
             own = mapFrom(folder_.path("own.quadmap"));
  ASSERT_EQ(both.confirmedObjects().size(), 3u);
  for (const MapObject* object : own.confirmedObjects())
  {
    EXPECT_LT((both.find(object->id)->object.center() - object->object.center()).norm(), 0.02);
    EXPECT_EQ(both.find(object->id)->observations(), 2 * object->observations());
  }
  const auto json = report("both.merge.json");
  EXPECT_EQ(json["format"], "quadmap-merge");
  EXPECT_EQ(readFile(folder_.path("both.merge.json")).back(), '\n');
  EXPECT_EQ(json["own"]["sha256"], sha256OfFile(folder_.path("own.quadmap")));
  EXPECT_EQ(json["other"]["file"], folder_.path("other.simplemap"));
  EXPECT_EQ(json["newer"], "other");
  EXPECT_NEAR(json["shift_and_yaw"][0], kOther.x(), 0.02);
  EXPECT_NEAR(json["shift_and_yaw"][3], kOther.yaw(), 0.01);
  EXPECT_EQ(json["objects"].size(), 3u);
  EXPECT_TRUE(json["conflicts"].empty());
}

TEST_F(QuadmapMapMerge, TellsWhatIsGoneByTheFramesOfTheNewerMap)
{
  // Three objects that stayed tell the place.
  const std::vector<quadmap::testing::TrueObject> bed = {
      quadmap::testing::cuboid("bed", {3.5, -1.0, 0.3}, {1.6, 2.0, 0.6}, 0.8)};
  sampleMap(bed).saveToFile(folder_.path("own.quadmap"));
  otherSession("couch", bed).saveToFile(folder_.path("later.simplemap"));
  const auto result = run("@own.quadmap @later.simplemap -o @both.quadmap");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("gone: couch ("), kNotFound) << result.out;
  EXPECT_TRUE(mapFrom(folder_.path("both.quadmap")).withLabel("couch").empty());
  const auto conflicts = report("both.merge.json")["conflicts"];
  ASSERT_EQ(conflicts.size(), 1u);
  EXPECT_EQ(conflicts[0]["kind"], "gone");
  EXPECT_TRUE(conflicts[0]["id"].is_null());
  EXPECT_FALSE(conflicts[0]["own"].is_null());
}

TEST_F(QuadmapMapMerge, RefusesTheSameMapTwice)
{
  std::filesystem::copy(folder_.path("own.quadmap"), folder_.path("copy.quadmap"));
  for (const char* second : {"@own.quadmap", "@copy.quadmap"})
  {
    const auto result = run("@own.quadmap " + std::string(second) + " -o @both.quadmap");
    EXPECT_EQ(result.status, 2) << second;
    EXPECT_NE(result.err.find("are maps of the same frames"), kNotFound) << result.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.path("both.quadmap")));
}

TEST_F(QuadmapMapMerge, RefusesMapsOfOtherPlacesAndDamagedOnes)
{
  CQuadricObjectMap elsewhere;
  const auto own = mapFrom(folder_.path("own.quadmap"));
  for (const MapObject* object : own.confirmedObjects())
  {
    MapObject other = *object;
    other.labelCounts = {
        {"cup", 10}
    };
    elsewhere.addObject(other);
  }
  elsewhere.saveToFile(folder_.path("elsewhere.quadmap"));
  const std::string whole = readFile(folder_.path("own.quadmap"));
  folder_.write("short.quadmap", whole.substr(0, whole.size() / 2));
  const std::size_t files = folder_.fileCount();
  for (const std::string name : {"elsewhere.quadmap", "short.quadmap", "missing.quadmap"})
  {
    const auto result = run("@own.quadmap @" + name + " -o @both.quadmap");
    EXPECT_EQ(result.status, 1) << name;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find(folder_.path(name) + ": "), kNotFound) << result.err;
    EXPECT_EQ(folder_.fileCount(), files);
  }
}

TEST_F(QuadmapMapMerge, WrongCallsAreTold)
{
  namespace fs = std::filesystem;
  fs::create_directory(folder_.path("home"));
  fs::copy(folder_.path("own.quadmap"), folder_.path("home/objects.quadmap"));
  fs::copy(folder_.path("other.simplemap"), folder_.path("home/objects.simplemap"));
  for (const char* arguments :
       {"@own.quadmap -o @x", "@own.quadmap --keep 1 -o @x",
        "@own.quadmap @other.simplemap --keep 1 --absorb 2 -o @x",
        "@own.quadmap @other.simplemap @own.quadmap -o @x",
        "@own.quadmap @other.simplemap -o @own.quadmap",
        "@own.quadmap @other.simplemap -o @both.json", "@home @home/objects.simplemap -o @x",
        "@own.quadmap --keep 1 --absorb 2 --config @x.ini -o @x"})
  {
    const auto result = run(arguments);
    EXPECT_EQ(result.status, 2) << arguments << result.err;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
  }
}
