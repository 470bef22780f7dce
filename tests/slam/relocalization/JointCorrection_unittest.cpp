#include <gtest/gtest.h>

#include <cmath>

#include "../../maps/ObjectMapFixture.h"
#include "backend/JointBackEnd.h"
#include "relocalization/KnownObjects.h"

using namespace quadmap;
using namespace quadmap::testing;
using mrpt::poses::CPose3D;

namespace
{
/** Low enough that the camera sees all tops. */
std::vector<TrueObject> lowFurniture()
{
  return {
      cuboid("refrigerator", {-1.2, -1.0, 0.6}, {0.6, 0.65, 1.2}, 0.2),
      cuboid("suitcase", {0.9, -1.1, 0.3}, {0.7, 0.4, 0.6}, 0.7),
      cuboid("dining table", {0, 0, 0.375}, {1.4, 0.9, 0.75}, 0.1),
      cuboid("chair", {1.0, 1.0, 0.45}, {0.45, 0.5, 0.9}, 0.4),
      cuboid("tv", {-1.3, 0.6, 0.9}, {0.8, 0.15, 0.5}, 1.2)};
}

/** As good as a map gets: made at the true poses. */
CQuadricObjectMap mapOf(const std::vector<TrueObject>& world)
{
  CQuadricObjectMap map;
  SyntheticCamera camera(1);
  camera.disturbances.poseSigma = camera.disturbances.poseAngleSigma = 0;
  walkAround(map, camera, world, 36);
  map.consolidate();
  return map;
}

/** Once around the room. The odometry starts at a place that is wrong, and each step errs a little
 * to the same side. */
struct DriftingRun
{
  std::vector<CPose3D> truth;
  std::vector<CObservationObjects::Ptr> boxes;
  SlamResult result;

  DriftingRun(const std::vector<TrueObject>& world, unsigned seed)
  {
    constexpr int kFrames = 36;
    const CPose3D stepError(0.004, 0.003, 0, 0.003, 0, 0);  // [m], [rad]
    mrpt::math::CMatrixDouble66 covariance;
    for (int i = 0; i < 6; ++i) covariance(i, i) = std::pow(i < 3 ? 0.005 : 0.003, 2);
    SyntheticCamera camera(seed);
    for (int i = 0; i < kFrames; ++i)
    {
      truth.push_back(poseAround(i, kFrames));
      boxes.push_back(CObservationObjects::Create(camera.observe(truth.back(), world)));
      Keyframe keyframe;
      if (i == 0)
        keyframe.T_map_robot = CPose3D(0.1, -0.08, 0, 0.03, 0, 0) + truth.back();
      else
      {
        const CPose3D step = (truth.back() - truth[truth.size() - 2]) + stepError;
        keyframe.odometryStep = {step, covariance};
        keyframe.T_map_robot = result.keyframes.back().T_map_robot + step;
      }
      keyframe.T_odom_robot = keyframe.T_map_robot;
      result.keyframes.push_back(keyframe);
    }
  }

  /** The objects of the two maps are those of the same label.
   * \param cauchy Kernel of what the map says; none: as it is. */
  void correctBy(const CQuadricObjectMap& given, std::optional<double> cauchy = {})
  {
    const auto known = [&](const CQuadricObjectMap& local)
    {
      std::vector<std::pair<ObjectId, ObjectId>> pairs;
      for (const MapObject* object : local.confirmedObjects())
        if (const auto* same = given.nearest(pointOf(object->object.center()), object->label()))
          pairs.emplace_back(object->id, same->id);
      auto priors = priorsOf(local, given, pairs, {});
      if (cauchy)
        for (auto& [id, prior] : priors) prior.cauchy = *cauchy;
      return priors;
    };
    JointBackEnd backEnd({}, result.map.insertionOptions, result.map.labels());
    backEnd.correctWith(
        known, [this](std::size_t k) { return boxes[k]; }, result);
  }

  double worstError() const
  {
    double worst = 0;
    for (std::size_t k = 0; k < truth.size(); ++k)
      worst = std::max(worst, result.keyframes[k].T_map_robot.distanceTo(truth[k]));
    return worst;
  }
};

// What may be left of errors [m]. Poses: 8 mm and 0.03 rad of a measurement at 2.6 m are averaged
// by several objects and, through the odometry, by neighbours. Objects: outer sides that are hardly
// seen.
constexpr double kCorrected = 0.03, kObject = 0.06;
}  // namespace

TEST(JointCorrection, KnownObjectsPullADriftedRunBack)
{
  const auto world = lowFurniture();
  const CQuadricObjectMap given = mapOf(world);
  ASSERT_NO_FATAL_FAILURE(expectMapOf(given, world, kObject));
  DriftingRun run(world, 2);
  ASSERT_GT(run.worstError(), 0.25);
  run.correctBy(given);
  EXPECT_LT(run.worstError(), kCorrected);
  EXPECT_NO_FATAL_FAILURE(expectMapOf(run.result.map, world, kObject));
  for (const auto& keyframe : run.result.keyframes)
  {
    ASSERT_TRUE(keyframe.covariance);
    EXPECT_GT((*keyframe.covariance)(0, 0), 0) << "the first one is not exact, either";
  }
}

TEST(JointCorrection, LetsGoOfAKnownObjectThatWasMoved)
{
  const auto now = lowFurniture();
  auto before = now;
  before[1] = cuboid("suitcase", {1.2, -1.5, 0.3}, {0.7, 0.4, 0.6}, 0.7);  // half a metre away
  const CQuadricObjectMap given = mapOf(before);
  double letGo = 0, believed = 0;
  for (const unsigned seed : {3, 4, 5, 6, 7, 8})
  {
    DriftingRun run(now, seed);
    run.correctBy(given);
    EXPECT_LT(run.worstError(), kCorrected) << seed;
    EXPECT_NO_FATAL_FAILURE(expectMapOf(run.result.map, now, kObject)) << seed;
    letGo += run.worstError();

    DriftingRun believing(now, seed);
    believing.correctBy(given, 0.0);
    believed += believing.worstError();
  }
  EXPECT_GT(believed, 2 * letGo) << "if the map were taken at its word";
}
