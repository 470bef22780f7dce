#include "backend/LoopClosure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "../../obs/InstalledLabels.h"
#include "backend/JointBackEnd.h"
#include "backend/OdometryDrift.h"
#include "backend/SightedObjects.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
/** A robot that goes along x and back, one keyframe each half metre. The odometry claims 5 cm and
 * 1 degree for a step. */
class ThereAndBack
{
 public:
  static constexpr std::size_t kKeyframes = 41;

  ThereAndBack()
  {
    result_.map.setLabels(labels());
    for (std::size_t k = 0; k < kKeyframes; ++k)
    {
      const double x = 0.5 * static_cast<double>(std::min(k, kKeyframes - 1 - k));
      Keyframe keyframe;
      keyframe.T_map_robot = keyframe.T_odom_robot = CPose3D(x, 0, 0, 0, 0, 0);
      if (k > 0)
      {
        mrpt::poses::CPose3DPDFGaussian step(
            keyframe.T_map_robot - result_.keyframes.back().T_map_robot);
        for (int i = 0; i < 6; ++i) step.cov(i, i) = i < 3 ? 0.05 * 0.05 : 3e-4;
        keyframe.odometryStep = step;
      }
      result_.keyframes.push_back(keyframe);
    }
  }

  /** An object that was taken for what boxes of some keyframes show. */
  void add(
      const std::string& label, const Eigen::Vector3d& center, const std::vector<std::uint32_t>& by)
  {
    MapObject object;
    object.object =
        Ellipsoid(CPose3D(center.x(), center.y(), center.z(), 0, 0, 0), {0.2, 0.2, 0.3});
    object.covariance = 1e-4 * UprightCovariance::Identity();
    object.labelCounts = {
        {label, 10}
    };
    object.completeCount = 10;
    object.orientationDefined = false;
    const ObjectId id = result_.map.addObject(object);
    for (const std::uint32_t k : by)
    {
      BoxDecision decision;
      decision.keyframe = k;
      decision.decision.box = boxes_[k]++;
      decision.decision.object = id;
      result_.decisions.push_back(decision);
    }
  }

  /** Four things beside the start of the way. */
  void addPlace(const Eigen::Vector3d& at, const std::vector<std::uint32_t>& by)
  {
    add("chair", at + Eigen::Vector3d(1, 1, 0.3), by);
    add("chair", at + Eigen::Vector3d(1.8, 1.1, 0.3), by);
    add("potted plant", at + Eigen::Vector3d(1.2, -0.9, 0.3), by);
    add("trash can", at + Eigen::Vector3d(0.3, -1.2, 0.3), by);
  }

  std::optional<Doubles> doubles() const
  {
    const auto sighted = sightedObjects(result_);
    const ConstellationOptions options;
    const DoublesRules rules{sighted, labels(), options};
    const OdometryDrift drift(result_.keyframes, {});
    return findDoubles(rules, doublesCandidates(rules, drift), drift, [] { return false; });
  }

  SlamResult& result() { return result_; }

 private:
  SlamResult result_;
  std::map<std::uint32_t, std::size_t> boxes_;
};

const std::vector<std::uint32_t> kBefore = {0, 1, 2, 3}, kAgain = {36, 37, 38, 39};
const Eigen::Vector3d kDrifted(0.3, 0.6, 0.2);  // [m]

}  // namespace

TEST(LoopClosure, TakesDoublesForOneWhenNothingElseWasTorn)
{
  ThereAndBack run;
  run.addPlace({0, 0, 0}, kBefore);
  run.addPlace(kDrifted, kAgain);
  run.add("couch", {5, 2, 0.3}, {10, 11});
  const auto doubles = run.doubles();
  ASSERT_TRUE(doubles);
  EXPECT_FALSE(becameOne(*doubles, run.result(), run.result()));

  ThereAndBack closed;
  closed.addPlace({0, 0, 0}, {0, 1, 2, 3, 36, 37, 38, 39});
  closed.add("couch", {5, 2, 0.3}, {10});
  EXPECT_TRUE(becameOne(*doubles, run.result(), closed.result()));
  closed.add("couch", {6, 2, 0.3}, {11});
  EXPECT_FALSE(becameOne(*doubles, run.result(), closed.result()));
}

// There are no boxes that could make them one.
TEST(LoopClosure, LeavesARunAsItWasWhereDoublesDoNotBecomeOne)
{
  ThereAndBack run;
  run.addPlace({0, 0, 0}, kBefore);
  run.addPlace(kDrifted, kAgain);
  SlamResult& result = run.result();
  result.correction.emplace();
  EXPECT_EQ(result.loops.warning(), "");
  const auto before = result.keyframes;
  JointBackEnd backEnd({}, result.map.insertionOptions, labels());
  backEnd.closeLoops([](std::size_t) { return nullptr; }, [] { return false; }, result);
  EXPECT_EQ(result.loops.closed, 0);
  ASSERT_TRUE(result.loops.open);
  EXPECT_EQ(result.loops.open->objects, 4U);
  EXPECT_EQ(result.map.objects().size(), 8U);
  for (std::size_t k = 0; k < before.size(); ++k)
    EXPECT_EQ(result.keyframes.at(k).T_map_robot, before[k].T_map_robot);
  EXPECT_EQ(
      result.loops.warning(),
      "4 objects may be twice in the map, up to 0.7 m apart, and could not be made one: poses and "
      "objects are doubtful");
}

TEST(LoopClosure, BringsDoublesTogetherByTheStepsBetween)
{
  ThereAndBack run;
  run.addPlace({0, 0, 0}, kBefore);
  run.addPlace(kDrifted, kAgain);
  const auto doubles = run.doubles();
  ASSERT_TRUE(doubles);
  auto keyframes = run.result().keyframes;
  bringTogether(*doubles, run.result().map, 0.02, {}, keyframes);
  EXPECT_NEAR(keyframes.front().T_map_robot.norm(), 0, 1e-9) << "the first keyframe stays";
  for (const auto& pair : doubles->pairs)
  {
    const auto& k = run.result().keyframes;
    const auto moved = [&](ObjectId id, std::size_t by)
    {
      const Eigen::Vector3d c = run.result().map.find(id)->object.center();
      const auto p =
          (keyframes[by].T_map_robot + (-k[by].T_map_robot)).composePoint({c.x(), c.y(), c.z()});
      return Eigen::Vector3d(p.x, p.y, p.z);
    };
    const double left =
        (moved(pair.before, pair.keyframeBefore) - moved(pair.again, pair.keyframeAgain)).norm();
    EXPECT_LT(left, 0.05) << "[m]; sigma is 0.02 m each";
  }
}
