#include "backend/QuadricBackEnd.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>
#include <set>

#include "../../graph/GraphWorld.h"
#include "../../maps/ObjectMapFixture.h"
#include "../../quadric/BoxScene.h"
#include "quadmap/perception/BoxEdges.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

namespace
{
/** A robot that drives twice around some ellipsoids, whose boxes it sees and nothing else. */
class Drive
{
 public:
  explicit Drive(unsigned seed) : random_(seed)
  {
    const std::vector<std::pair<std::string, Eigen::Vector3d>> things = {
        {       "chair", {0.26, 0.25, 0.45}},
        {    "suitcase", {0.25, 0.15, 0.35}},
        {"potted plant",    {0.3, 0.3, 0.4}},
        {       "chair", {0.24, 0.26, 0.46}},
        {        "vase",  {0.12, 0.12, 0.2}},
        {    "suitcase",   {0.3, 0.2, 0.32}}
    };
    for (std::size_t i = 0; i < things.size(); ++i)
    {
      const double at = 2 * M_PI * static_cast<double>(i) / static_cast<double>(things.size());
      const auto& [label, half] = things[i];
      objects.emplace_back(
          label,
          Ellipsoid(
              CPose3D(0.9 * std::cos(at), 0.9 * std::sin(at), half.z(), 0.5 * at, 0, 0), half));
    }
    constexpr int kPoses = 72;
    for (int k = 0; k < kPoses; ++k)
    {
      truth.push_back(robotOnCircle({0, 0, 0}, 4 * M_PI * k / kPoses));
      if (k == 0)
        odometry.push_back(truth[0]);
      else
        odometry.push_back(odometry.back() + step(truth[k] - truth[k - 1]));
    }
  }

  std::vector<std::pair<std::string, Ellipsoid>> objects;
  std::vector<CPose3D> truth, odometry;
  /** Whether a keyframe shows the i-th object. */
  std::function<bool(std::size_t i, std::size_t keyframe)> isShown = [](auto, auto)
  { return true; };

  CObservationObjects::Ptr boxesAt(std::size_t k) const
  {
    std::mt19937 random(static_cast<unsigned>(100 + k));  // the same whenever it is asked for
    auto boxes = CObservationObjects::Create();
    boxes->timestamp = mrpt::Clock::fromDouble(1000.0 + 0.2 * static_cast<double>(k));
    boxes->sensorPose = robotCamera();
    boxes->cameraParams.ncols = kVga.width;
    boxes->cameraParams.nrows = kVga.height;
    boxes->cameraParams.setIntrinsicParamsFromValues(kVga.fx, kVga.fy, kVga.cx, kVga.cy);
    const auto T_map_optical = truth[k] + robotCamera() + T_sensor_optical();
    for (std::size_t i = 0; i < objects.size(); ++i)
    {
      const auto& [label, object] = objects[i];
      if (!isShown(i, k)) continue;
      const auto box = projectEllipsoidBox(kVga, object.transformed(-T_map_optical));
      if (!box) continue;
      DetectedObject d;
      d.label = label;
      d.instanceId = static_cast<std::uint32_t>(i);
      std::normal_distribution<double> noise(0, 3);  // [px]
      d.box =
          ImageBox{
              box->x1 + noise(random), box->y1 + noise(random), box->x2 + noise(random),
              box->y2 + noise(random)}
              .clipped(kVga.width, kVga.height);
      if (d.box.area() > 0.5 * box->area()) boxes->objects.push_back(d);
    }
    measureWithoutDepth(*boxes, PerceptionOptions());
    return boxes;
  }

  void run(BackEnd& backEnd, const std::vector<CPose3D>& poses, SlamResult& result) const
  {
    for (std::size_t k = 0; k < poses.size(); ++k)
    {
      std::optional<mrpt::poses::CPose3DPDFGaussian> motion;
      if (k > 0) motion = stepOf(poses[k] - poses[k - 1]);
      Keyframe keyframe;
      keyframe.T_odom_robot = poses[k];
      keyframe.odometryStep = motion;
      keyframe.T_map_robot = backEnd.addKeyframe(poses[k], motion, boxesAt(k).get(), result);
      result.keyframes.push_back(keyframe);
    }
    backEnd.finish([this](std::size_t k) { return boxesAt(k); }, result);
  }

  /** Every object is in the map once, and nothing else is. */
  void expectMapped(const SlamResult& result, double share) const
  {
    EXPECT_EQ(result.map.confirmedObjects().size(), objects.size()) << result.map.asString();
    for (const auto& [label, object] : objects)
    {
      const MapObject* found = result.map.nearest(pointOf(object.center()), label);
      ASSERT_TRUE(found) << label;
      EXPECT_LT((found->object.center() - object.center()).norm(), share * object.semiAxes().norm())
          << label;
    }
  }

 private:
  static constexpr double kSigma = 0.012, kAngle = 0.006;  // [m], [rad]
  std::mt19937 random_;

  double gauss(double sigma) { return std::normal_distribution<double>(0, sigma)(random_); }
  CPose3D step(const CPose3D& T)
  {
    return {T.x() + gauss(kSigma),   T.y() + gauss(kSigma),   T.z() + gauss(kSigma / 4),
            T.yaw() + gauss(kAngle), T.pitch() + gauss(1e-4), T.roll() + gauss(1e-4)};
  }
  static mrpt::poses::CPose3DPDFGaussian stepOf(const CPose3D& mean)
  {
    mrpt::poses::CPose3DPDFGaussian step(mean);
    const double sigmas[] = {kSigma, kSigma, kSigma / 4, kAngle, 1e-4, 1e-4};
    for (int i = 0; i < 6; ++i) step.cov(i, i) = sigmas[i] * sigmas[i];
    return step;
  }
};

}  // namespace

TEST(QuadricBackEnd, MapsObjectsFromGivenPoses)
{
  const Drive drive(1);
  const LabelTable labels = LabelTable::installed();
  QuadricBackEnd backEnd(JointOptions(), InsertionOptions(), false, labels);
  SlamResult result;
  drive.run(backEnd, drive.truth, result);
  drive.expectMapped(result, 0.1);
  EXPECT_FALSE(result.correction);
  for (std::size_t k = 0; k < drive.truth.size(); ++k)
    EXPECT_LT((result.keyframes[k].T_map_robot - drive.truth[k]).norm(), 1e-9);
  std::set<ObjectId> inEdges;
  for (const auto& edge : result.edges) inEdges.insert(edge.object);
  EXPECT_EQ(inEdges.size(), drive.objects.size()) << "the pose graph has edges to each";
  for (const auto& box : result.decisions)
    EXPECT_TRUE(!box.decision.object || result.map.find(*box.decision.object));
}

TEST(QuadricBackEnd, BelievesGivenAssociations)
{
  const Drive drive(1);
  const LabelTable labels = LabelTable::installed();
  SlamConfiguration configuration;
  configuration.slam.method = SlamMethod::Quadric;
  configuration.slam.association = AssociationSource::Given;
  SlamResult result;
  drive.run(*createBackEnd(configuration, labels), drive.odometry, result);
  EXPECT_EQ(result.map.confirmedObjects().size(), drive.objects.size());
  std::map<std::uint32_t, std::set<ObjectId>> objectsOf;
  for (const auto& [keyframe, decision] : result.decisions)
  {
    const auto boxes = drive.boxesAt(keyframe);
    if (decision.object)
      objectsOf[*boxes->objects.at(decision.box).instanceId].insert(*decision.object);
  }
  EXPECT_EQ(objectsOf.size(), drive.objects.size());
  for (const auto& [instance, ids] : objectsOf) EXPECT_EQ(ids.size(), 1u) << instance;
}

TEST(QuadricBackEnd, WithoutRoundsTheMapIsThatOfTheDrive)
{
  Drive drive(1);
  const std::size_t late = drive.truth.size() - 2;  // too late to be an object
  drive.isShown = [late](std::size_t i, std::size_t k) { return i != 2 || k >= late; };
  const LabelTable labels = LabelTable::installed();
  JointOptions options;
  options.rounds = 0;
  QuadricBackEnd backEnd(options, InsertionOptions(), true, labels);
  SlamResult result;
  drive.run(backEnd, drive.odometry, result);
  EXPECT_GE(result.map.confirmedObjects().size(), drive.objects.size() - 1);
  EXPECT_FALSE(result.map.nearest(pointOf(drive.objects[2].second.center()), "potted plant"));
  EXPECT_FALSE(result.edges.empty());
  for (const auto& edge : result.edges) EXPECT_TRUE(result.map.find(edge.object));
}

TEST(QuadricBackEnd, BoxesOfAbsorbedObjectsShowTheOneThatWasKept)
{
  for (const bool correctPoses : {false, true})
  {
    Drive drive(1);
    const Eigen::Vector3d half(0.26, 0.25, 0.45);  // two chairs, shown in turn
    drive.objects = {
        {"chair",  {CPose3D(0, 0.35, 0.45, 0, 0, 0), half}},
        {"chair", {CPose3D(0, -0.35, 0.45, 0, 0, 0), half}}
    };
    drive.isShown = [](std::size_t i, std::size_t k) { return k % 2 == i; };
    const LabelTable labels = LabelTable::installed();
    InsertionOptions insertion;
    insertion.merging.penetration = 10;  // and taken for one
    JointOptions options;
    options.rounds = 0;
    QuadricBackEnd backEnd(options, insertion, correctPoses, labels);
    SlamResult result;
    drive.run(backEnd, drive.truth, result);
    EXPECT_EQ(result.map.confirmedObjects().size(), 1u);
    std::size_t started = 0;
    for (const auto& [keyframe, decision] : result.decisions)
    {
      started += decision.startedObject ? 1 : 0;
      EXPECT_TRUE(!decision.startedObject || decision.object) << keyframe;
    }
    EXPECT_GE(started, 2u);
  }
}

TEST(QuadricBackEnd, CorrectsTheOdometry)
{
  for (const unsigned seed : {1u, 2u, 3u})
  {
    const Drive drive(seed);
    const LabelTable labels = LabelTable::installed();
    QuadricBackEnd backEnd(JointOptions(), InsertionOptions(), true, labels);
    SlamResult result;
    drive.run(backEnd, drive.odometry, result);
    ASSERT_TRUE(result.correction);
    const double odometry =
        positionError(drive.truth, [&](std::size_t k) { return drive.odometry[k]; });
    const double corrected =
        positionError(drive.truth, [&](std::size_t k) { return result.keyframes[k].T_map_robot; });
    EXPECT_LT(corrected, 0.7 * odometry) << seed << ": " << odometry << " m by odometry";
    drive.expectMapped(result, 0.5);
  }
}
