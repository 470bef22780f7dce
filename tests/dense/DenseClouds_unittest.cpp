#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <sstream>

#include "ResultFolder.h"
#include "quadmap/base/OutputGroup.h"
#include "quadmap/dense/ObjectPoints.h"
#include "quadmap/dense/RoomCloud.h"

using namespace quadmap;
using quadmap::testing::ResultFolder;

namespace
{
void ignoreProgress(double) {}

/** Distance of a point from the surface of a cuboid, negative inside [m]. */
double distanceFrom(const Ellipsoid& cuboid, const Eigen::Vector3f& p_map)
{
  const Eigen::Vector3d p =
      cuboid.rotation().transpose() * (p_map.cast<double>() - cuboid.center());
  const Eigen::Vector3d beyond = p.cwiseAbs() - cuboid.semiAxes();
  return beyond.maxCoeff() > 0 ? beyond.cwiseMax(0).norm() : beyond.maxCoeff();
}

/** The floats of the points of a file, after its header. */
std::vector<float> floatsAfter(const std::string& text, const std::string& endOfHeader)
{
  const auto from = text.find(endOfHeader);
  EXPECT_NE(from, std::string::npos);
  const std::string body = text.substr(from + endOfHeader.size());
  std::vector<float> floats(body.size() / sizeof(float));
  std::memcpy(floats.data(), body.data(), floats.size() * sizeof(float));
  return floats;
}

DensePoint samplePoint(float x)
{
  DensePoint point;
  point.position = {x, 2, 3};
  point.normal = {0, 0.6F, 0.8F};
  point.curvature = 0.25F;
  point.rgb = {10, 20, 30};
  return point;
}
}  // namespace

TEST(RoomCloud, LiesOnTheSurfacesThatTheKeyframesSaw)
{
  const SyntheticRoom room;
  const ResultFolder result;
  DenseOptions options;
  options.roomCell = 0.03;
  const DenseCloud cloud = fuseRoom(result.path(), options, ignoreProgress);
  ASSERT_GT(cloud.size(), 3000u);
  std::set<std::array<int, 3>> cells;
  std::size_t onCuboid = 0;
  for (const DensePoint& point : cloud)
  {
    const double fromCuboid = std::abs(distanceFrom(room.box, point.position));
    onCuboid += fromCuboid < 0.006 ? 1 : 0;
    // The mean of a cell that an edge of the cuboid crosses lies off both of its sides.
    EXPECT_LT(std::min(fromCuboid, std::abs(double(point.position.z()))), 0.02);
    const Eigen::Vector3i cell = (point.position / 0.03F).array().floor().cast<int>();
    cells.insert({cell.x(), cell.y(), cell.z()});
  }
  EXPECT_EQ(cells.size(), cloud.size()) << "one point per cell";
  EXPECT_GT(onCuboid, 500u);
}

TEST(RoomCloud, HasNormalsTowardsTheCameras)
{
  const SyntheticRoom room;
  const DenseCloud cloud = fuseRoom(ResultFolder().path(), {}, ignoreProgress);
  std::size_t flat = 0;
  for (const DensePoint& point : cloud)
  {
    if (distanceFrom(room.box, point.position) < 0.1) continue;
    EXPECT_GT(point.normal.z(), 0.9F) << "the floor faces up";
    EXPECT_LT(point.curvature, 0.05F);
    ++flat;
  }
  EXPECT_GT(flat, 10000u);
}

TEST(RoomCloud, LeavesOutWhatIsTooFar)
{
  const SyntheticRoom room;
  const ResultFolder result(room, 1);
  const auto T_map_camera = room.robotAt(0) + room.T_robot_camera;
  const Eigen::Vector3f eye(
      float(T_map_camera.x()), float(T_map_camera.y()), float(T_map_camera.z()));
  DenseOptions options;
  options.minHits = 1;
  const auto farthest = [&](double maxRange)
  {
    options.maxRange = maxRange;
    float most = 0;
    for (const DensePoint& point : fuseRoom(result.path(), options, ignoreProgress))
      most = std::max(most, (point.position - eye).norm());
    return most;
  };
  // The range is along the optical axis: in the corners of the image points are farther away.
  EXPECT_GT(farthest(2.0), 2.0F);
  EXPECT_LT(farthest(2.0), 2.6F);
  EXPECT_GT(farthest(4.0), 4.0F);
}

TEST(RoomCloud, TakesAsManyKeyframesAsItMay)
{
  const SyntheticRoom room;
  DenseOptions options, onlyOne;
  onlyOne.maxKeyframes = 1;
  const auto first = fuseRoom(ResultFolder(room, 1).path(), options, ignoreProgress);
  EXPECT_EQ(fuseRoom(ResultFolder(room, 16).path(), onlyOne, ignoreProgress).size(), first.size());
}

/** What is said of a run whose only keyframe has this scan. */
std::string complaintAbout(
    const ResultFolder& result, const mrpt::obs::CObservation3DRangeScan::Ptr& scan)
{
  mrpt::maps::CSimpleMap map;
  mrpt::obs::CSensoryFrame frame;
  frame.insert(scan);
  map.insert(mrpt::poses::CPose3DPDFGaussian(), frame);
  EXPECT_TRUE(map.saveToFile(result.folder().path("map.simplemap")));
  try
  {
    fuseRoom(result.path(), {}, ignoreProgress);
  }
  catch (const std::runtime_error& e)
  {
    return e.what();
  }
  return "";
}

TEST(RoomCloud, NamesTheKeyframeWhoseDepthCannotBeUsed)
{
  SyntheticRoom room;
  const ResultFolder result(room, 2);
  auto scan = room.scanFrom(room.robotAt(0), 0);
  scan->cameraParams.setIntrinsicParamsFromValues(0, 0, 0, 0);
  const std::string said = complaintAbout(result, scan);
  EXPECT_NE(said.find("map.simplemap: keyframe 1: "), std::string::npos) << said;
}

TEST(RoomCloud, NeedsADepthImage)
{
  const SyntheticRoom room;
  const ResultFolder result(room, 2);
  auto scan = room.scanFrom(room.robotAt(0), 0);
  scan->hasRangeImage = false;
  const std::string said = complaintAbout(result, scan);
  EXPECT_NE(said.find("map.simplemap: no keyframe has a depth image"), std::string::npos) << said;
}

TEST(ObjectPoints, AreTheSurfaceOfTheObjectWhateverSizeTheMapSays)
{
  const SyntheticRoom room;
  const ResultFolder result;
  const auto found = findObjectPoints(result.path(), {result.record()}, {}, ignoreProgress);
  ASSERT_EQ(found.size(), 1u);
  const ObjectPoints& object = found.front();
  ASSERT_GT(object.cloud.size(), 1000u);
  ASSERT_EQ(object.weights.size(), object.cloud.size());
  ASSERT_TRUE(object.supportHeight);
  EXPECT_NEAR(*object.supportHeight, 0, 0.002);
  EXPECT_EQ(object.eyes.size(), 16u);
  Eigen::Vector3d low = Eigen::Vector3d::Constant(9), high = -low;
  for (const DensePoint& point : object.cloud)
  {
    EXPECT_LT(std::abs(distanceFrom(room.box, point.position)), 0.01);
    EXPECT_GE(point.position.z(), 0.999 * DenseOptions().clearance)
        << "the floor is not the object's";
    const Eigen::Vector3d p =
        room.box.rotation().transpose() * (point.position.cast<double>() - room.box.center());
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Eigen::Vector3d half = room.box.semiAxes();
  EXPECT_LT((high - half).cwiseAbs().maxCoeff(), 0.01) << "it reaches all faces, and no farther";
  EXPECT_LT((low + half).head<2>().cwiseAbs().maxCoeff(), 0.01);
  EXPECT_LT(low.z() + half.z(), 0.03) << "down to what was removed with the floor";
}

TEST(ObjectPoints, OfAnObjectWithoutBoxesAreNone)
{
  const ResultFolder result;
  ObjectRecord other = result.record();
  other.id = "8";
  const auto found = findObjectPoints(result.path(), {other}, {}, ignoreProgress);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found.front().cloud.empty());
}

TEST(ObjectPoints, GoToFilesNamedByIdAndLabel)
{
  const TemporaryFolder folder;
  ObjectPoints table, nothing;
  table.record.id = "7";
  table.record.label = "dining table/../x";
  table.cloud = {samplePoint(1)};
  nothing.record.id = "8";
  OutputGroup group;
  const auto names = writeObjectClouds({table, nothing}, folder.path("new/clouds"), group);
  group.commit();
  EXPECT_EQ(names, std::vector<std::string>{"7_dining_table____x.pcd"});
  EXPECT_TRUE(std::filesystem::exists(folder.path("new/clouds/7_dining_table____x.pcd")));
}

TEST(ObjectPoints, HaveShortFileNames)
{
  ObjectRecord record;
  record.id = "7";
  record.label = std::string(300, 'x');
  EXPECT_EQ(fileNameOf(record, ".pcd"), "7_" + std::string(64, 'x') + ".pcd");
}

TEST(ObjectPoints, ReplaceTheFilesOfAnEarlierCallOnly)
{
  const TemporaryFolder folder;
  ObjectPoints cup, table;
  cup.record.id = "3";
  cup.record.label = "cup";
  table.record.id = "7";
  table.record.label = "table";
  cup.cloud = table.cloud = {samplePoint(1)};
  const auto write = [&](const std::vector<ObjectPoints>& objects)
  {
    OutputGroup group;
    writeObjectClouds(objects, folder.path(""), group);
    group.commit();
  };
  write({cup, table});
  folder.write("3_scan.pcd", "# .PCD v0.7 - Point Cloud Data file format\n");
  folder.write("3_notes.txt", "mine");
  table.record.label = "desk";
  write({table});
  std::set<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(folder.folder()))
    names.insert(file.path().filename().string());
  EXPECT_EQ(names, (std::set<std::string>{"3_notes.txt", "3_scan.pcd", "7_desk.pcd"}));
}

TEST(CloudFiles, PcdHasTheFieldsThatItsHeaderNames)
{
  const TemporaryFolder folder;
  writeCloud({samplePoint(1), samplePoint(4)}, folder.path("c.pcd"));
  const std::string text = readFile(folder.path("c.pcd"));
  std::map<std::string, std::string> header;
  std::istringstream lines(text);
  for (std::string key, line; header.count("DATA") == 0 && lines >> key; header[key] = line)
    std::getline(lines >> std::ws, line);
  EXPECT_EQ(header["FIELDS"], "x y z normal_x normal_y normal_z curvature rgb");
  EXPECT_EQ(header["SIZE"], "4 4 4 4 4 4 4 4");
  EXPECT_EQ(header["POINTS"], "2");
  EXPECT_EQ(header["WIDTH"], "2");
  EXPECT_EQ(header["DATA"], "binary");
  const auto floats = floatsAfter(text, "DATA binary\n");
  ASSERT_EQ(floats.size(), 16u);
  EXPECT_EQ(
      std::vector<float>(floats.begin() + 8, floats.begin() + 15),
      (std::vector<float>{4, 2, 3, 0, 0.6F, 0.8F, 0.25F}));
  std::uint32_t packed = 0;
  std::memcpy(&packed, &floats[15], sizeof(packed));
  EXPECT_EQ(packed, 0x0A141Eu);
}

TEST(CloudFiles, PlyHasTheFieldsThatItsHeaderNames)
{
  const TemporaryFolder folder;
  writeCloud({samplePoint(1)}, folder.path("c.ply"));
  const std::string text = readFile(folder.path("c.ply"));
  EXPECT_EQ(text.rfind("ply\nformat binary_little_endian 1.0\n", 0), 0u);
  EXPECT_NE(text.find("\nelement vertex 1\n"), std::string::npos);
  const std::string body = text.substr(text.find("end_header\n") + 11);
  ASSERT_EQ(body.size(), 7 * sizeof(float) + 3);
  EXPECT_EQ(body.substr(28), std::string("\x0A\x14\x1E"));
  EXPECT_EQ(floatsAfter(text, "end_header\n")[4], 0.6F);
}

TEST(CloudFiles, RefuseOtherNames)
{
  EXPECT_TRUE(isCloudName("a/b.pcd") && isCloudName("b.ply"));
  EXPECT_FALSE(isCloudName("b.png") || isCloudName("pcd"));
  EXPECT_THROW(writeCloud({}, "x.obj"), std::invalid_argument);
}
