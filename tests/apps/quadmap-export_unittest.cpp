#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfObjects.h>

#include <algorithm>

#include "../obs/FileSizeLimit.h"
#include "../review/SampleScene.h"
#include "FolderContents.h"
#include "MappedRoom.h"
#include "SampleMap.h"
#include "quadmap/obs/Trajectory.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
/** A folder as quadmap-slam writes it, with the files that the program reads. */
class QuadmapExport : public ::testing::Test
{
 protected:
  QuadmapExport()
  {
    sampleMap().saveToFile(folder_.path("objects.quadmap"));
    Trajectory trajectory, odometry;
    mrpt::maps::CSimpleMap keyframes;
    for (int i = 0; i < 8; ++i)
    {
      const CPose3D T_map_robot(0.1 * i, 0, 0.5, 0.7 * i, 0, 0);
      trajectory.push_back({10.0 + i, T_map_robot});
      odometry.push_back({10.0 + i, CPose3D(0.12 * i, 0, 0.5, 0.7 * i, 0, 0)});
      quadmap::testing::addKeyframe(keyframes, T_map_robot, quadmap::testing::scanOfWall());
    }
    writeTumTrajectory(folder_.path("trajectory.tum"), trajectory);
    writeTumTrajectory(folder_.path("trajectory_odometry.tum"), odometry);
    EXPECT_TRUE(keyframes.saveToFile(folder_.path("map.simplemap")));
  }

  /** Arguments with DIR for the folder. No display. */
  ProgramResult run(const std::string& arguments) const
  {
    ::unsetenv("DISPLAY");
    return runProgram("quadmap-export", replaced(arguments, "DIR", folder_.folder().string()));
  }

  void expectRefusal(const std::string& arguments, const std::string& why) const
  {
    const std::string name = folder_.folder().filename().string();
    const auto result = run(replaced(arguments, "REST", name));
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find(why), kNotFound) << arguments << "\n" << result.err;
  }

  bool exists(const std::string& name) const { return std::filesystem::exists(folder_.path(name)); }

  TemporaryFolder folder_;
};

/** Share of the pixels that are neither white nor grey. */
double colouredShare(const mrpt::img::CImage& picture)
{
  std::size_t coloured = 0;
  for (unsigned y = 0; y < picture.getHeight(); ++y)
    for (unsigned x = 0; x < picture.getWidth(); ++x)
    {
      const std::uint8_t* c = picture.ptr<std::uint8_t>(x, y);
      coloured += std::max({c[0], c[1], c[2]}) - std::min({c[0], c[1], c[2]}) > 60 ? 1 : 0;
    }
  return static_cast<double>(coloured) / static_cast<double>(picture.getWidth()) /
         static_cast<double>(picture.getHeight());
}

std::size_t childrenOf(mrpt::opengl::COpenGLScene& scene, const std::string& group)
{
  const auto found = std::dynamic_pointer_cast<mrpt::opengl::CSetOfObjects>(scene.getByName(group));
  return found ? found->size() : 0;
}
}  // namespace

TEST_F(QuadmapExport, TakesAMapInAnyOfItsForms)
{
  EXPECT_TRUE(simpleMapOfSample().saveToFile(folder_.path("objects.simplemap")));
  for (const char* form : {"DIR", "DIR/objects.quadmap", "DIR/objects.simplemap"})
  {
    const auto result = run(std::string(form) + " --json DIR/out.json");
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(readObjectsJson(folder_.path("out.json")).size(), 3u) << form;
  }
}

TEST_F(QuadmapExport, PagesDoNotTellFolders)
{
  if (!std::filesystem::exists("/usr/share/javascript/three/three.min.js"))
    GTEST_SKIP() << "libjs-three is not installed";
  const std::string name = folder_.folder().filename().string();
  for (const char* input : {"DIR", "DIR/", "DIR/objects.quadmap"})
  {
    const auto result =
        run(std::string(input) + " --html DIR/p.html --compare DIR/objects.quadmap");
    ASSERT_EQ(result.status, 0) << result.err;
    const std::string page = readFile(folder_.path("p.html"));
    EXPECT_NE(page.find("\"title\":\"" + name + "\""), kNotFound) << input;
    EXPECT_NE(page.find("\"comparedName\":\"" + name + "\""), kNotFound) << input;
    EXPECT_EQ(page.find(folder_.folder().string()), kNotFound) << input;
  }
}

TEST_F(QuadmapExport, MakesNoSheetWithoutImages)
{
  for (const char* arguments : {"DIR/objects.quadmap", "DIR --no-cloud"})
  {
    const auto result = run(std::string(arguments) + " --sheet DIR/c.png");
    EXPECT_EQ(result.status, 1) << arguments;
    EXPECT_NE(result.err.find("--sheet needs images"), kNotFound) << result.err;
  }
  EXPECT_FALSE(exists("c.png"));
}

TEST_F(QuadmapExport, WritesEverythingOfAFolder)
{
  const auto result =
      run("DIR --scene DIR/s.3Dscene --png DIR/p.png --top DIR/t.png --ply DIR/m.ply --glb "
          "DIR/m.glb --sheet DIR/c.png --json DIR/o.json --size 320x200");
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* file : {"s.3Dscene", "p.png", "t.png", "m.ply", "m.glb", "c.png", "o.json"})
  {
    EXPECT_TRUE(exists(file)) << file;
    EXPECT_NE(result.out.find("wrote " + folder_.path(file)), kNotFound) << result.out;
  }
  EXPECT_EQ(readObjectsJson(folder_.path("o.json")).size(), 3u);

  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile(folder_.path("s.3Dscene")));
  EXPECT_EQ(childrenOf(scene, "labels"), 3u);
  for (const char* part : {"trajectory", "odometry", "cameras"})
    EXPECT_TRUE(scene.getByName(part)) << part;
  const auto cloud =
      std::dynamic_pointer_cast<mrpt::opengl::CPointCloudColoured>(scene.getByName("cloud"));
  ASSERT_TRUE(cloud);
  EXPECT_GT(cloud->size(), 100u);

  for (const char* file : {"p.png", "t.png"})
  {
    mrpt::img::CImage picture;
    ASSERT_TRUE(picture.loadFromFile(folder_.path(file)));
    EXPECT_EQ(picture.getWidth(), 320u);
    EXPECT_EQ(picture.getHeight(), 200u);
    EXPECT_GT(colouredShare(picture), 0.05) << file << ": three coloured objects";
  }
}

TEST_F(QuadmapExport, ShowsASingleMapAndTheTruth)
{
  writeObjectsJson(folder_.path("gt.json"), sampleMap().toRecords());
  const auto result = run(
      "DIR/objects.quadmap --scene DIR/s.3Dscene --truth DIR/gt.json --in-place --json DIR/o.json");
  ASSERT_EQ(result.status, 0) << result.err;
  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile(folder_.path("s.3Dscene")));
  EXPECT_EQ(childrenOf(scene, "truth"), 3u);
  EXPECT_EQ(childrenOf(scene, "labels"), 3u);
}

TEST_F(QuadmapExport, NamesTrueObjectsAsTheMapDoes)
{
  if (!std::filesystem::exists("/usr/share/javascript/three/three.min.js"))
    GTEST_SKIP() << "libjs-three is not installed";
  std::vector<ObjectRecord> records = sampleMap().toRecords();
  for (ObjectRecord& record : records)
    if (record.label == "couch") record.label = "Sofa_1";
  writeObjectsJson(folder_.path("gt.json"), records);
  const auto result =
      run("DIR/objects.quadmap --html DIR/m.html --truth DIR/gt.json --in-place --no-cloud");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(readFile(folder_.path("m.html")).find("Sofa_1"), kNotFound)
      << "another spelling of the label is no difference";
}

TEST_F(QuadmapExport, CarriesTheTruthIntoTheMapByTheTrajectories)
{
  // The true world is the map turned by a quarter and shifted.
  const CPose3D T_truth_map(3, -2, 0.5, M_PI / 2, 0, 0);
  std::vector<ObjectRecord> records = sampleMap().toRecords();
  for (ObjectRecord& record : records) record.object = record.object.transformed(T_truth_map);
  writeObjectsJson(folder_.path("gt.json"), records);
  Trajectory truth = readTumTrajectory(folder_.path("trajectory.tum"));
  for (StampedPose& stamped : truth) stamped.pose = T_truth_map + stamped.pose;
  writeTumTrajectory(folder_.path("gt.tum"), truth);

  const auto result =
      run("DIR --no-cloud --scene DIR/s.3Dscene --truth DIR/gt.json --trajectory DIR/gt.tum");
  ASSERT_EQ(result.status, 0) << result.err;
  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile(folder_.path("s.3Dscene")));
  const auto truthDrawn =
      std::dynamic_pointer_cast<mrpt::opengl::CSetOfObjects>(scene.getByName("truth"));
  ASSERT_EQ(truthDrawn->size(), records.size());
  const auto expected = sampleMap().toRecords();
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const auto drawn =
        (*std::next(truthDrawn->begin(), static_cast<std::ptrdiff_t>(i)))->getBoundingBox();
    const auto corners = expected[i].object.cuboidCorners();
    const Eigen::Vector3d low = corners.rowwise().minCoeff(), high = corners.rowwise().maxCoeff();
    constexpr double kLineWidth = 0.02;  // [m]
    EXPECT_NEAR(static_cast<double>(drawn.min.x), low.x(), kLineWidth) << expected[i].label;
    EXPECT_NEAR(static_cast<double>(drawn.min.y), low.y(), kLineWidth) << expected[i].label;
    EXPECT_NEAR(static_cast<double>(drawn.max.x), high.x(), kLineWidth) << expected[i].label;
    EXPECT_NEAR(static_cast<double>(drawn.max.z), high.z(), kLineWidth) << expected[i].label;
  }
}

TEST_F(QuadmapExport, WritesAPageOfAFolderAndOfAMap)
{
  if (!std::filesystem::exists("/usr/share/javascript/three/three.min.js"))
    GTEST_SKIP() << "libjs-three is not installed";
  ASSERT_EQ(run("DIR --html DIR/p.html").status, 0);
  const std::string page = readFile(folder_.path("p.html"));
  EXPECT_NE(page.find("\"label\":\"refrigerator\""), kNotFound);
  EXPECT_NE(page.find("\"jpeg\":\"/9j/"), kNotFound) << "the keyframes' images, as JPEG";
  ASSERT_EQ(run("DIR/objects.quadmap --html DIR/m.html --compare DIR").status, 0);
  EXPECT_EQ(readFile(folder_.path("m.html")).find("\"jpeg\":"), kNotFound) << "a map has none";

  const auto missing = run("DIR --html DIR/x.html --three DIR/nowhere");
  EXPECT_EQ(missing.status, 1);
  EXPECT_TRUE(isOneLine(missing.err)) << missing.err;
  EXPECT_NE(missing.err.find("libjs-three"), kNotFound) << missing.err;
  EXPECT_FALSE(exists("x.html"));
}

TEST_F(QuadmapExport, LeavesOutTheCloudWhenAsked)
{
  ASSERT_EQ(run("DIR --scene DIR/s.3Dscene --no-cloud").status, 0);
  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile(folder_.path("s.3Dscene")));
  const auto cloud =
      std::dynamic_pointer_cast<mrpt::opengl::CPointCloudColoured>(scene.getByName("cloud"));
  EXPECT_TRUE(!cloud || cloud->size() == 0);
  EXPECT_TRUE(scene.getByName("trajectory"));
}

TEST_F(QuadmapExport, NeedsNothingButTheMap)
{
  for (const char* file : {"map.simplemap", "trajectory.tum", "trajectory_odometry.tum"})
    std::filesystem::remove(folder_.path(file));
  const auto result = run("DIR --png DIR/p.png --size 160x100");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(exists("p.png"));
}

TEST_F(QuadmapExport, DrawsThePicturesOfTheKeyframes)
{
  ASSERT_NO_FATAL_FAILURE(mapRoom(folder_.path("room"), "home --resolution 160x120 --frames 12"));
  const auto result = run("DIR/room --frames DIR/new/frames");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("wrote 12 pictures into "), kNotFound) << result.out;
  for (const char* name : {"frame-000000.jpg", "frame-000011.jpg"})
  {
    mrpt::img::CImage picture;
    ASSERT_TRUE(picture.loadFromFile(folder_.path(std::string("new/frames/") + name)));
    EXPECT_GT(picture.getWidth(), 1000u);
  }
  EXPECT_FALSE(exists("new/frames/frame-000012.jpg"));

  const auto expectError = [&](const std::string& arguments, const std::string& name)
  {
    const auto failed = run(arguments + " --frames DIR/none");
    EXPECT_EQ(failed.status, 1) << arguments;
    EXPECT_TRUE(isOneLine(failed.err)) << failed.err;
    EXPECT_NE(failed.err.find(name), kNotFound) << failed.err;
  };
  expectError("DIR/room/objects.quadmap", "needs a folder");
  folder_.write("room/report.json", "{\"associations\": [7]}");
  expectError("DIR/room", "report.json");
  std::filesystem::remove(folder_.path("room/objects.simplemap"));
  expectError("DIR/room", "objects.simplemap");
}

TEST_F(QuadmapExport, RefusesCloudsThatItCannotWrite)
{
  const auto expectError = [&](const std::string& arguments, int status, const std::string& text)
  {
    const auto result = run(arguments);
    EXPECT_EQ(result.status, status) << arguments;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find(text), kNotFound) << result.err;
  };
  expectError("DIR --cloud DIR/c.obj", 2, "must end in .pcd or .ply");
  expectError("DIR --json DIR/o.json --config DIR/d.ini", 2, "belongs to --cloud");
#ifdef QUADMAP_WITH_PCL
  expectError("DIR/objects.quadmap --cloud DIR/c.pcd", 1, "--cloud needs a folder");
  expectError("DIR --object-clouds DIR/c", 1, "objects.simplemap");
  folder_.write("d.ini", "[dense]\nroomCell = -1\n");
  expectError("DIR --cloud DIR/c.pcd -c DIR/d.ini", 1, "roomCell");
  EXPECT_FALSE(exists("c.pcd") || exists("c"));
#else
  expectError("DIR --cloud DIR/c.pcd", 1, "built without PCL");
#endif
}

#ifdef QUADMAP_WITH_PCL
TEST_F(QuadmapExport, WritesTheSameCloudsWhateverTheThreads)
{
  ASSERT_NO_FATAL_FAILURE(mapRoom(
      folder_.path("room"), "home --resolution 160x120 --frames 30", "--odometry ground-truth"));
  folder_.write("d.ini", "[dense]\nroomCell = 0.03\nobjectCell = 0.02\n");
  for (const char* threads : {"1", "3"})
  {
    ::setenv("OMP_NUM_THREADS", threads, 1);
    const std::string arguments = "DIR/room -c DIR/d.ini --cloud DIR/" + std::string(threads) +
                                  ".ply --object-clouds DIR/new/clouds" + threads;
    const auto result = run(arguments);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.out.find("points"), kNotFound) << result.out;
  }
  ::unsetenv("OMP_NUM_THREADS");
  folder_.write("strict.ini", "[dense]\nminHits = 1000\n");
  const auto nothing = run("DIR/room -c DIR/strict.ini --object-clouds DIR/nothing");
  EXPECT_EQ(nothing.status, 1) << nothing.out;
  EXPECT_NE(nothing.err.find("--object-clouds found no points of any of its"), kNotFound)
      << nothing.err;
  EXPECT_FALSE(exists("nothing"));
  EXPECT_EQ(readFile(folder_.path("1.ply")), readFile(folder_.path("3.ply")));
  EXPECT_GT(readFile(folder_.path("1.ply")).size(), 100000u);
  std::size_t clouds = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path("new/clouds1")))
  {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(readFile(entry.path().string()), readFile(folder_.path("new/clouds3/" + name)))
        << name;
    ++clouds;
  }
  EXPECT_GE(clouds, 5u);

  folder_.write("d.ini", "[dense]\nmaxRange = 0.5\n");
  const auto empty = run("DIR/room -c DIR/d.ini --cloud DIR/empty.ply");
  EXPECT_EQ(empty.status, 1);
  EXPECT_NE(empty.err.find("found no points"), kNotFound) << empty.err;
  EXPECT_FALSE(exists("empty.ply"));
}
#endif

TEST_F(QuadmapExport, WritesAllItsOutputsOrNone)
{
  folder_.write("o.json", "old");
  const std::size_t before = folder_.fileCount();
  for (const char* wrong : {"DIR/none/s.3Dscene", "/dev/full"})
  {
    const auto result =
        run("DIR --no-cloud --json DIR/o.json --ply DIR/o.ply --glb DIR/o.glb --scene " +
            std::string(wrong));
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_EQ(result.out, "") << wrong;
    EXPECT_EQ(readFile(folder_.path("o.json")), "old") << wrong;
    EXPECT_EQ(folder_.fileCount(), before) << wrong;
  }
  const auto result = run("DIR --no-cloud --json DIR/o.json --ply DIR/o.ply");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(folder_.fileCount(), before + 1);
}

TEST_F(QuadmapExport, NamesTheFileItCannotRead)
{
  const auto expectError = [&](const std::string& arguments, const std::string& name)
  {
    const auto result = run(arguments + " --scene DIR/s.3Dscene");
    EXPECT_EQ(result.status, 1) << arguments;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find(name), kNotFound) << result.err;
    EXPECT_FALSE(exists("s.3Dscene")) << arguments;
  };
  expectError("/nonexistent", "/nonexistent");
  expectError("/usr", "/usr/objects.quadmap");
  expectError("DIR/trajectory.tum", "trajectory.tum");
  expectError("DIR --truth DIR/missing.json --in-place", "missing.json");
  folder_.write("gt.json", R"({"objects": []})");
  expectError("DIR --truth DIR/gt.json --trajectory DIR/missing.tum", "missing.tum");
  expectError(
      "DIR/objects.quadmap --truth DIR/gt.json --trajectory DIR/trajectory.tum",
      "a map file has no trajectory");
  auto many = sampleMap().toRecords();
  many.resize(1001, many.front());
  for (std::size_t i = 0; i < many.size(); ++i) many[i].id = std::to_string(i);
  writeObjectsJson(folder_.path("many.json"), many);
  expectError(
      "DIR --truth DIR/many.json --in-place",
      "many.json and " + folder_.folder().string() + ": 1001 true objects, at most 1000 can be ");
  const auto cutInHalf = [&](const std::string& name)
  {
    const std::string whole = readFile(folder_.path(name));
    folder_.write(name, whole.substr(0, whole.size() / 2));
  };
  cutInHalf("map.simplemap");
  expectError("DIR", "map.simplemap");
  folder_.write("trajectory.tum", "1 2 3\n");
  expectError("DIR", "trajectory.tum");
  cutInHalf("objects.quadmap");
  expectError("DIR", "objects.quadmap");
}

TEST_F(QuadmapExport, NamesTheFileItCannotWrite)
{
  for (const char* option :
       {"--scene /nonexistent/x.3Dscene", "--png /nonexistent/x.png", "--ply /nonexistent/x.ply",
        "--json /nonexistent/x.json"})
  {
    const auto result = run("DIR --size 64x64 " + std::string(option));
    EXPECT_EQ(result.status, 1) << option;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find("/nonexistent/x"), kNotFound) << result.err;
  }
}

TEST_F(QuadmapExport, ReplacesNoFileThatItReads)
{
  folder_.write("report.json", "{}");
  simpleMapOfSample().saveToFile(folder_.path("objects.simplemap"));
  writeObjectsJson(folder_.path("gt.json"), sampleMap().toRecords());
  std::filesystem::create_symlink("objects.quadmap", folder_.path("page"));
  std::filesystem::create_hard_link(folder_.path("trajectory.tum"), folder_.path("mesh"));
  const auto before = contentsOf(folder_.folder());
  for (const char* arguments :
       {"DIR --json DIR/report.json", "DIR --html DIR/page", "DIR --glb DIR/mesh",
        "DIR/objects.quadmap --html DIR/page", "DIR/objects.quadmap --json DIR/report.json",
        "DIR --json DIR/gt.json --truth DIR/gt.json --in-place",
        "DIR --json DIR/../REST/report.json"})
    expectRefusal(arguments, "is read and stays as it is");
  for (const char* output :
       {"--html DIR/objects.quadmap", "--ply DIR/objects.simplemap", "--scene DIR/map.simplemap",
        "--glb DIR/new.quadmap", "--json DIR/new.tum", "--html DIR/report.json",
        "--json DIR/new.rawlog.gz"})
    expectRefusal("DIR " + std::string(output), "files of this kind end in");
  EXPECT_EQ(contentsOf(folder_.folder()), before);
  EXPECT_EQ(run("DIR --json DIR/objects.txt --ply DIR/mesh2 --no-cloud").status, 0);
}

TEST_F(QuadmapExport, FullDiskLeavesNoTruncatedScene)
{
  ASSERT_EQ(run("DIR --scene DIR/whole.3Dscene").status, 0);
  const auto size = std::filesystem::file_size(folder_.path("whole.3Dscene"));
  const auto files = folder_.fileCount();
  const FileSizeLimit limit(size - 1);  // the very last byte fails
  const auto result = run("DIR --scene DIR/s.3Dscene");
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(isOneLine(result.err)) << result.err;
  EXPECT_NE(result.err.find("s.3Dscene: cannot be written: "), kNotFound) << result.err;
  EXPECT_EQ(folder_.fileCount(), files);
}

TEST_F(QuadmapExport, AnswersWrongUsageWithStatus2AndOneLine)
{
  for (const char* arguments :
       {"", "DIR", "--png DIR/p.png", "DIR --png", "DIR --png DIR/p.jpeg", "DIR --pgn DIR/p.png",
        "DIR --png DIR/p.png --size big", "DIR --png DIR/p.png --size 10x10",
        "DIR --png DIR/p.png --size 5000x100", "DIR DIR --png DIR/p.png", "DIR --no-cloud",
        "DIR --png DIR/p.png --truth DIR/gt.json", "DIR --png DIR/p.png --in-place",
        "DIR --png DIR/p.png --truth DIR/gt.json --in-place --trajectory DIR/trajectory.tum",
        "DIR --png DIR/p.png --compare DIR", "DIR --sheet DIR/c.jpg",
        "DIR --html DIR/p.htm --size 1x1"})
  {
    const auto result = run(arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_TRUE(isOneLine(result.err)) << arguments << "\n" << result.err;
    EXPECT_EQ(result.err.find("quadmap-export: "), 0u) << result.err;
  }
}

TEST_F(QuadmapExport, SaysWhenOpenGLIsMissing)
{
  // No vendor of EGL: as on a machine without Mesa.
  ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json", 1);
  const auto result = run("DIR --png DIR/p.png");
  ::unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("pictures cannot be rendered"), kNotFound) << result.err;
  EXPECT_FALSE(exists("p.png"));
}
