// Tests every kind of odometry in both formats of rawlogs. One recording is written anew with each
// kind by MRPT's own classes, and the program maps it.
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "OdometryRecords.h"
#include "RunProgram.h"
#include "quadmap/obs/Trajectory.h"
#include "quadmap/sensors/RawlogNames.h"

using namespace quadmap;
using mrpt::poses::CPose3D;
using nlohmann::json;

namespace
{
constexpr double kText = 1e-5;  // [m], [rad]; of the decimals in trajectories

/** A simulated recording, with odometry that drifts in the plane. */
std::vector<Moment> simulated(const TemporaryFolder& folder)
{
  const auto file = folder.path("simulated.rawlog");
  const auto scene = folder.write(
      "scene.ini",
      "[include]\nfile1 = common/robot-home-room.ini\n"
      "[camera]\nwidth = 160\nheight = 120\nfocal = 131\nposition = 0.1 0 0.9\npitch_deg = 12\n"
      "[trajectory]\nframes = 8\nduration = 30\n");
  const auto result = runProgram("quadmap-simulate", scene + " -o " + file);
  EXPECT_EQ(result.status, 0) << result.err;
  std::vector<Moment> moments;
  for (const auto& object : readRecords(file))
    if (const auto pose = std::dynamic_pointer_cast<mrpt::obs::CObservationRobotPose>(object))
    {
      if (pose->sensorLabel != kOdometryLabel) continue;
      moments.push_back({mrpt::Clock::toDouble(pose->timestamp), {}, {}});
      moments.back().T_odom_robot = CPose3D(planar(pose->pose.mean));
    }
    else if (const auto image = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object))
      moments.back().images.push_back(image);
  EXPECT_EQ(moments.size(), 8u);
  return moments;
}

/** The motion since the first pose. */
std::vector<CPose3D> motionOf(const std::vector<CPose3D>& poses)
{
  std::vector<CPose3D> motion;
  for (const auto& pose : poses) motion.push_back(pose - poses.front());
  return motion;
}

class EveryOdometry : public ::testing::Test
{
 protected:
  static void SetUpTestSuite()
  {
    folder_ = std::make_unique<TemporaryFolder>();
    moments_ = simulated(*folder_);
  }
  static void TearDownTestSuite()
  {
    folder_.reset();
    moments_.clear();
  }

  static ProgramResult run(
      const Records& records, const std::string& arguments = "--method odometry")
  {
    std::filesystem::remove_all(folder_->path("out"));
    writeObjects(folder_->path("x.rawlog"), records);
    std::filesystem::copy_file(
        folder_->path("simulated.objects.rawlog"), folder_->path("x.objects.rawlog"),
        std::filesystem::copy_options::overwrite_existing);
    return runProgram(
        "quadmap-slam",
        folder_->path("x.rawlog") + " -o " + folder_->path("out") + " --every 1 " + arguments);
  }

  static std::vector<CPose3D> poses(const std::string& file)
  {
    std::vector<CPose3D> poses;
    for (const auto& p : readTumTrajectory(folder_->path("out/") + file)) poses.push_back(p.pose);
    return poses;
  }

  static std::string reportedOdometry()
  {
    return json::parse(readFile(folder_->path("out/report.json")))["input"]["odometry"];
  }

  /** Expects that the program finds this odometry by itself, says so, and follows it. */
  static void expectFound(const Records& records, const std::string& kind)
  {
    const auto result = run(records);
    ASSERT_EQ(result.status, 0) << kind << ": " << result.err;
    EXPECT_NE(result.out.find("poses: the rawlog's odometry, " + kind + "\n"), kNotFound)
        << result.out;
    EXPECT_EQ(reportedOdometry(), kind);
    std::vector<CPose3D> truth;
    for (const Moment& m : moments_) truth.push_back(m.T_odom_robot);
    const auto expected = motionOf(truth), found = motionOf(poses("trajectory_odometry.tum"));
    ASSERT_EQ(found.size(), expected.size()) << kind;
    for (std::size_t k = 0; k < found.size(); ++k)
    {
      const CPose3D error = found[k] - expected[k];
      EXPECT_LT(error.norm(), kText) << kind << ", image " << k;
      EXPECT_LT(std::abs(error.yaw()) + std::abs(error.pitch()) + std::abs(error.roll()), 4 * kText)
          << kind << ", image " << k;
    }
  }

  static std::unique_ptr<TemporaryFolder> folder_;
  static std::vector<Moment> moments_;
};
std::unique_ptr<TemporaryFolder> EveryOdometry::folder_;
std::vector<Moment> EveryOdometry::moments_;

constexpr auto kPose = "CObservationRobotPose tracker", kWheels = "CObservationOdometry wheels";
constexpr auto kMove2D = "CActionRobotMovement2D", kMove3D = "CActionRobotMovement3D";
}  // namespace

TEST_F(EveryOdometry, OfObservationsMovesTheRobotAlike)
{
  expectFound(observationLog(moments_, {robotPose}), kPose);
  expectFound(observationLog(moments_, {wheels}), kWheels);
  expectFound(observationLog(moments_, {wheelsWithTicks}), kWheels);
}

TEST_F(EveryOdometry, OfActionsAndSensoryFramesMovesTheRobotAlike)
{
  expectFound(actionLog(moments_, gaussianMove, {}), kMove2D);
  expectFound(actionLog(moments_, thrunMove, {}), kMove2D);
  expectFound(actionLog(moments_, matchedMove, {}), kMove2D);
  expectFound(actionLog(moments_, spatialMove, {}), kMove3D);
  expectFound(actionLog(moments_, {}, {robotPose}), kPose);
  expectFound(actionLog(moments_, {}, {wheels}), kWheels);
}

TEST_F(EveryOdometry, TheBestOfSeveralIsTaken)
{
  const auto slipping = [](const Moment& m)
  {
    auto o = wheels(m);
    o->odometry.x_incr(0.5 * (m.time - moments_.front().time));
    return o;
  };
  expectFound(observationLog(moments_, {slipping, robotPose}), kPose);
  expectFound(actionLog(moments_, spatialMove, {slipping}), kMove3D);
  expectFound(actionLog(moments_, gaussianMove, {slipping}), kMove2D);
  const MoveRecord slippingMove = [](const Moment& a, const Moment& b, auto& actions)
  { matchedMove(b, a, actions); };
  expectFound(actionLog(moments_, slippingMove, {robotPose}), kPose);
}

TEST_F(EveryOdometry, OneThatIsSeldomThereIsNotTheBest)
{
  Records records;
  for (const Moment& m : moments_)
  {
    if (&m == &moments_[6]) records.push_back(robotPose(m));  // a fix now and then
    records.push_back(wheels(m));
    records.insert(records.end(), m.images.begin(), m.images.end());
  }
  expectFound(records, kWheels);
}

TEST_F(EveryOdometry, BehindTheImagesIsNotReplacedSilently)
{
  Records records, poses;
  for (const auto& record : readRecords(QUADMAP_SOURCE_DIR "/rawlogs/home.rawlog"))
    if (std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(record))
      records.push_back(record);
    else
      poses.push_back(record);
  records.resize(30);  // more than are looked at before the run
  records.insert(records.end(), poses.begin(), poses.end());
  // The boxes beside the rawlog are those of another one.
  const auto result = run(records, "--method odometry --keep-going");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(reportedOdometry(), "visual odometry camera");
  EXPECT_NE(
      result.err.find("x.rawlog: CObservationRobotPose odometry starts behind the first images"),
      kNotFound)
      << result.err;
}

TEST_F(EveryOdometry, RandomModelsOfMotionGiveTheSameMapEveryTime)
{
  const auto records = actionLog(moments_, thrunMove, {});
  std::string first;
  for (int i = 0; i < 2; ++i)
  {
    ASSERT_EQ(run(records, "").status, 0);
    const auto graph = readFile(folder_->path("out/pose-graph.graph"));
    EXPECT_TRUE(first.empty() || first == graph);
    first = graph;
  }
}

TEST_F(EveryOdometry, TruthAndImagesWhenAskedForOrNothingElseIsThere)
{
  const auto truth = [](const Moment& m)
  { return samplePose(m.time, m.T_odom_robot, "ground_truth"); };
  ASSERT_EQ(
      run(observationLog(moments_, {truth, wheels}), "--method odometry --odometry ground-truth")
          .status,
      0);
  EXPECT_EQ(reportedOdometry(), "ground truth");
  const auto alone = run(observationLog(moments_, {}));
  EXPECT_NE(alone.out.find("poses: visual odometry of sensor camera"), kNotFound) << alone.out;
  const auto none = run(observationLog(moments_, {}), "--method odometry --odometry rawlog");
  EXPECT_EQ(none.status, 1);
  EXPECT_NE(none.err.find("no odometry"), kNotFound) << none.err;
}

TEST_F(EveryOdometry, BrokenRecordsAreNamedOrLeftOut)
{
  const auto spoilt = [](const std::function<void(mrpt::obs::CObservationRobotPose&)>& spoil)
  {
    auto records = observationLog(moments_, {robotPose});
    const auto per = records.size() / moments_.size();
    spoil(dynamic_cast<mrpt::obs::CObservationRobotPose&>(*records.at(5 * per)));
    return records;
  };
  const std::vector<std::pair<std::string, Records>> cases = {
      {             "not finite",
       spoilt([](auto& o) { o.pose.mean.x(std::numeric_limits<double>::quiet_NaN()); })         },
      {     "the time goes back", spoilt([](auto& o) { o.timestamp = stamp(moments_[2].time); })},
      {"ahead of that of record",  spoilt([](auto& o) { o.timestamp += std::chrono::hours(1); })},
      {  "the negative variance",                 spoilt([](auto& o) { o.pose.cov(0, 0) = -1; })}
  };
  for (const auto& [what, records] : cases)
  {
    const auto strict = run(records);
    EXPECT_EQ(strict.status, 1) << what;
    EXPECT_NE(strict.err.find("x.rawlog: record 10 (tracker): "), kNotFound) << strict.err;
    EXPECT_NE(strict.err.find(what), kNotFound) << strict.err;
    const auto tolerant = run(records, "--method odometry --keep-going");
    EXPECT_EQ(tolerant.status, 0) << tolerant.err;
    EXPECT_EQ(poses("trajectory.tum").size(), moments_.size() - 1) << what;
    EXPECT_EQ(reportedOdometry(), kPose);
  }
}

/** The recording, whose odometry has a hole between two of its images. */
Records withoutOdometry(const std::vector<Moment>& moments, std::size_t first, std::size_t end)
{
  Records records;
  for (std::size_t k = 0; k < moments.size(); ++k)
  {
    if (k < first || k >= end) records.push_back(robotPose(moments[k]));
    records.insert(records.end(), moments[k].images.begin(), moments[k].images.end());
  }
  return records;
}

TEST_F(EveryOdometry, MissingPosesLeaveTheirImagesOut)
{
  const auto result = run(withoutOdometry(moments_, 3, 6));
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find(".rawlog: 3 of 8 images have no pose"), kNotFound) << result.err;
  EXPECT_EQ(poses("trajectory.tum").size(), moments_.size() - 3);
}

TEST_F(EveryOdometry, FewPosesAreNoSilentSuccess)
{
  const Records records = withoutOdometry(moments_, 2, 7);
  const auto strict = run(records);
  EXPECT_EQ(strict.status, 1);
  EXPECT_NE(
      strict.err.find("x.rawlog: 5 of 8 images have no pose; --keep-going leaves them out\n"),
      kNotFound)
      << strict.err;
  const auto tolerant = run(records, "--method odometry --keep-going");
  EXPECT_EQ(tolerant.status, 0) << tolerant.err;
  EXPECT_NE(tolerant.err.find("5 of 8 images have no pose"), kNotFound) << tolerant.err;
  EXPECT_NE(tolerant.out.find("8 frames, 3 keyframes"), kNotFound) << tolerant.out;
}
