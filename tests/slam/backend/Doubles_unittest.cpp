#include "quadmap/constellation/Doubles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>

#include "backend/JointBackEnd.h"
#include "backend/LoopClosure.h"
#include "backend/OdometryDrift.h"
#include "backend/SightedObjects.h"

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
const LabelTable& labels()
{
  static const LabelTable table = LabelTable::installed();
  return table;
}

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

  /** An object that some keyframes saw. */
  ObjectId add(
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
    for (const std::uint32_t k : by) addBox(id, k);
    return id;
  }

  /** A box that a keyframe took for that object. */
  void addBox(ObjectId id, std::uint32_t k)
  {
    BoxDecision decision;
    decision.keyframe = k;
    decision.decision.box = boxes_[k]++;
    decision.decision.object = id;
    result_.decisions.push_back(decision);
  }

  /** Four things beside the start of the way, seen from that many keyframes. */
  std::vector<ObjectId> addPlace(
      const Eigen::Vector3d& at, std::uint32_t first, std::uint32_t count = 4)
  {
    std::vector<std::uint32_t> by;
    for (std::uint32_t k = first; k < first + count; ++k) by.push_back(k);
    return addPlace(at, by);
  }
  std::vector<ObjectId> addPlace(const Eigen::Vector3d& at, const std::vector<std::uint32_t>& by)
  {
    return {
        add("chair", at + Eigen::Vector3d(1, 1, 0.3), by),
        add("chair", at + Eigen::Vector3d(1.8, 1.1, 0.3), by),
        add("potted plant", at + Eigen::Vector3d(1.2, -0.9, 0.3), by),
        add("trash can", at + Eigen::Vector3d(0.3, -1.2, 0.3), by)};
  }

  std::optional<Doubles> doubles(
      double noise = 1, const std::function<bool()>& shouldStop = [] { return false; }) const
  {
    return findDoubles(
        sightedObjects(result_), OdometryDrift(result_.keyframes, {noise, noise}), labels(),
        ConstellationOptions(), shouldStop);
  }

  SlamResult& result() { return result_; }

 private:
  SlamResult result_;
  std::map<std::uint32_t, std::size_t> boxes_;
};

const Eigen::Vector3d kDrift(0.3, 0.6, 0.2);  // [m]

}  // namespace

TEST(Doubles, AreFoundWhereTheOdometryMayHaveDriftedThatFar)
{
  ThereAndBack run;
  const auto before = run.addPlace({0, 0, 0}, 0), again = run.addPlace(kDrift, 36);
  const auto doubles = run.doubles();
  ASSERT_TRUE(doubles);
  std::map<ObjectId, ObjectId> pairs;
  for (const auto& pair : doubles->pairs) pairs[pair.before] = pair.again;
  ASSERT_EQ(pairs.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(pairs[before[i]], again[i]);
  EXPECT_NEAR(doubles->distance, kDrift.norm(), 1e-6);
}

TEST(Doubles, AreNotFoundBeyondTheDrift)
{
  ThereAndBack run;
  run.addPlace({0, 0, 0}, 0);
  run.addPlace(kDrift, 36);
  EXPECT_FALSE(run.doubles(0.1));
}

// A heading that errs moves what is seen far away to the side, but hardly along the way.
TEST(Doubles, OfRoomsFurnishedAlikeAreFoundInTheDirectionOfTheDriftOnly)
{
  constexpr double kApart = 1.5;  // [m]
  ThereAndBack sideways, along;
  for (ThereAndBack* run : {&sideways, &along}) run->addPlace({0, 0, 0}, 0);
  sideways.addPlace({0, kApart, 0}, 36);
  along.addPlace({kApart, 0, 0}, 36);
  EXPECT_TRUE(sideways.doubles());
  EXPECT_FALSE(along.doubles());
}

// Asked for each pair that the search may start with: with four things twice, four times at least.
TEST(Doubles, AreNotSearchedAfterAStop)
{
  ThereAndBack run;
  run.addPlace({0, 0, 0}, 0);
  run.addPlace(kDrift, 36);
  int asked = 0;
  ASSERT_TRUE(run.doubles(1, [&] { return ++asked < 0; }));
  EXPECT_GE(asked, 4);
  for (const int last : {1, asked})
  {
    int now = 0;
    EXPECT_FALSE(run.doubles(1, [&] { return ++now == last; })) << last;
    EXPECT_EQ(now, last) << "it goes on no further";
  }
}

TEST(Doubles, AreNoThingsThatOneImageShows)
{
  ThereAndBack run;
  const auto before = run.addPlace({0, 0, 0}, 0);
  run.addPlace(kDrift, 36);
  ASSERT_TRUE(run.doubles());
  for (const ObjectId id : before) run.addBox(id, 36);
  EXPECT_FALSE(run.doubles());
}

TEST(Doubles, MayShareFewImages)
{
  ThereAndBack run;
  const ObjectId before = run.addPlace({0, 0, 0}, 0, 12).front();
  const ObjectId again = run.addPlace(kDrift, 29, 12).front();
  run.addBox(before, 30);  // one of twelve
  const auto doubles = run.doubles();
  ASSERT_TRUE(doubles);
  EXPECT_EQ(doubles->pairs.size(), 4U);
  EXPECT_TRUE(std::any_of(
      doubles->pairs.begin(), doubles->pairs.end(),
      [&](const auto& pair) { return pair.before == before && pair.again == again; }));
}

TEST(Doubles, AreNotFoundWhereOneThingAloneIsTwice)
{
  ThereAndBack run;
  run.add("chair", {1, 1, 0.3}, {0, 1, 2});
  run.add("chair", Eigen::Vector3d(1, 1, 0.3) + kDrift, {36, 37, 38});
  EXPECT_FALSE(run.doubles());
}

// The second place may be the first one, moved by half a metre along the row or by a whole one.
TEST(Doubles, AreNotFoundWhereTheyCouldBeOthersAsWell)
{
  ThereAndBack run;
  for (int i = 0; i < 6; ++i) run.add("chair", {0.5 * i, 1, 0.3}, {0, 1, 2});
  for (int i = 0; i < 4; ++i) run.add("chair", {0.5 * i + 0.25, 1.1, 0.3}, {36, 37, 38});
  EXPECT_FALSE(run.doubles());
}

TEST(Doubles, BecameOneWhenNothingElseWasTorn)
{
  ThereAndBack run;
  run.addPlace({0, 0, 0}, 0);
  run.addPlace(kDrift, 36);
  run.add("couch", {5, 2, 0.3}, {10, 11});
  const auto doubles = run.doubles();
  ASSERT_TRUE(doubles);
  EXPECT_FALSE(becameOne(*doubles, run.result(), run.result()));

  ThereAndBack closed;
  closed.addPlace({0, 0, 0}, std::vector<std::uint32_t>{0, 1, 2, 3, 36, 37, 38, 39});
  closed.add("couch", {5, 2, 0.3}, {10});
  EXPECT_TRUE(becameOne(*doubles, run.result(), closed.result()));
  closed.add("couch", {6, 2, 0.3}, {11});
  EXPECT_FALSE(becameOne(*doubles, run.result(), closed.result()));
}

// There are no boxes that could make them one.
TEST(Doubles, ThatDoNotBecomeOneLeaveARunAsItWas)
{
  ThereAndBack run;
  run.addPlace({0, 0, 0}, 0);
  run.addPlace(kDrift, 36);
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

TEST(Doubles, AreBroughtTogetherByTheStepsBetween)
{
  ThereAndBack run;
  run.addPlace({0, 0, 0}, 0);
  run.addPlace(kDrift, 36);
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
