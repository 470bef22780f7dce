// A recording of a calibration with negative fy, as ICL-NUIM's: the images are upright, and y
// points up in them, so that the world of its true poses is a mirror image.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "../odometry/visual/HomeFrames.h"
#include "RunProgram.h"
#include "quadmap/obs/ObjectList.h"
#include "quadmap/obs/Trajectory.h"

using namespace quadmap;
using mrpt::poses::CPose3D;
using nlohmann::json;

namespace
{
constexpr std::size_t kFrames = 60;

/** The same rigid motion or pose between mirrored frames. Mirrors are diagonal matrices. */
CPose3D mirrored(
    const CPose3D& pose, const Eigen::Vector3d& mirrorTo, const Eigen::Vector3d& mirrorFrom)
{
  const Eigen::Matrix3d R = pose.getRotationMatrix().asEigen();
  const Eigen::Vector3d t(pose.x(), pose.y(), pose.z());
  return CPose3D::FromRotationAndTranslation(
      Eigen::Matrix3d(mirrorTo.asDiagonal() * R * mirrorFrom.asDiagonal()),
      Eigen::Vector3d(mirrorTo.asDiagonal() * t));
}

void negateFy(mrpt::img::TCamera& camera)
{
  camera.setIntrinsicParamsFromValues(camera.fx(), -camera.fy(), camera.cx(), camera.cy());
}

/** Writes the start of the bundled recording and its truth. When it is mirrored, only numbers are:
 * the y axes of the world and of the optical frame, which is the sensor's z. */
void write(const TemporaryFolder& folder, const std::string& name, bool isMirrored)
{
  const Eigen::Vector3d world(1, -1, 1), sensor(1, 1, -1);
  std::vector<mrpt::serialization::CSerializable::Ptr> records;
  Trajectory trajectory;
  for (const auto& frame : homeFrames(kFrames))
  {
    ASSERT_EQ(frame.scan->sensorPose, CPose3D());
    CPose3D T_world_robot = *frame.T_world_robot;
    const auto boxes = CObservationObjects::Create(*frame.objects);
    if (isMirrored)
    {
      T_world_robot = mirrored(T_world_robot, world, sensor);
      for (auto* camera : {&frame.scan->cameraParams, &frame.scan->cameraParamsIntensity})
        negateFy(*camera);
      negateFy(boxes->cameraParams);
    }
    trajectory.push_back({frame.time(), T_world_robot});
    records.push_back(frame.scan);
    records.push_back(boxes);
  }
  writeObjects(folder.path(name + ".rawlog"), records);
  writeTumTrajectory(folder.path(name + ".tum"), trajectory);
  auto truth = readObjectsJson(QUADMAP_SOURCE_DIR "/rawlogs/home.objects.gt.json");
  for (auto& one : truth)  // a cuboid is its own mirror image
    if (isMirrored)
      one.object = Ellipsoid(
          mirrored(one.object.pose(), world, Eigen::Vector3d(1, -1, 1)), one.object.semiAxes());
  writeObjectsJson(folder.path(name + ".json"), truth);
}

/** The figures of a run against a truth. */
json evaluated(const TemporaryFolder& folder, const std::string& run, const std::string& truth)
{
  const auto figures = folder.path("figures.json"), name = folder.path(truth);
  const auto evaluation = runProgram(
      "quadmap-evaluate", folder.path(run) + " --objects " + name + ".json --trajectory " + name +
                              ".tum --json " + figures);
  EXPECT_EQ(evaluation.status, 0) << evaluation.err;
  EXPECT_EQ(evaluation.out.find("left-handed") != std::string::npos, run != truth);
  return json::parse(readFile(figures));
}

/** Maps a recording by visual odometry. All objects are reported, also those whose ends are hardly
 * known: of a bed whose far end no image shows, the rounding of flow would decide. \return Its
 * report, and the figures of its evaluation. */
std::pair<json, json> mapped(const TemporaryFolder& folder, const std::string& name)
{
  const auto out = folder.path(name);
  const auto options = folder.write(
      name + ".ini", "[CQuadricObjectMap_insertOpts]\nmaxCenterSigma = 100\nmaxSizeSigma = 100\n");
  const auto slam = runProgram(
      "quadmap-slam",
      out + ".rawlog --odometry visual --every 1 --config " + options + " -o " + out);
  EXPECT_EQ(slam.status, 0) << slam.err;
  return {json::parse(readFile(out + "/report.json")), evaluated(folder, name, name)};
}
}  // namespace

TEST(MirroredRecording, VisualOdometryMapsItAsTheOriginal)
{
  const TemporaryFolder folder;
  ASSERT_NO_FATAL_FAILURE(write(folder, "original", false));
  ASSERT_NO_FATAL_FAILURE(write(folder, "mirrored", true));
  const auto [report, expected] = mapped(folder, "original");
  const auto [mirroredReport, figures] = mapped(folder, "mirrored");
  EXPECT_EQ(report["visual_odometry"]["up"], "floor seen");
  EXPECT_EQ(mirroredReport["visual_odometry"]["up"], "floor seen");
  EXPECT_GT(expected["objects"]["f1"], 0.9);
  EXPECT_EQ(figures["objects"]["f1"], expected["objects"]["f1"]);
  const double ate = expected["trajectory"]["ate_rmse_m"];
  EXPECT_LT(figures["trajectory"]["ate_rmse_m"], 1.5 * ate)
      << "flow rounds in another way upside down";
  const auto page = runProgram(
      "quadmap-export", folder.path("original") + " --html " + folder.path("x.html") + " --truth " +
                            folder.path("mirrored.json") + " --trajectory " +
                            folder.path("mirrored.tum"));
  EXPECT_EQ(page.status, 0) << page.err;
  EXPECT_NE(page.err.find("quadmap-export: note: The true world is left-handed"), std::string::npos)
      << page.err;
  // The truth of the room judges its mirror image as well, and the other way round.
  for (const auto& [run, truth] : {
           std::pair("mirrored", "original"), {"original", "mirrored"}
  })
  {
    const auto crossed = evaluated(folder, run, truth);
    EXPECT_EQ(crossed["objects"]["f1"], expected["objects"]["f1"]) << run;
    EXPECT_LT(crossed["trajectory"]["ate_rmse_m"], 1.5 * ate) << run;
  }
}
