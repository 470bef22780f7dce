#include "quadmap/evaluation/TruthReflection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../geometry/RandomGeometry.h"
#include "quadmap/geometry/PinholeCamera.h"

using namespace quadmap;
using namespace quadmap::test;
using mrpt::poses::CPose3D;

namespace
{
/** A walk with turns about all axes, or about the vertical alone. */
std::vector<CPose3D> walk(bool onlyYaw)
{
  std::vector<CPose3D> poses;
  for (int i = 0; i < 60; ++i)
  {
    const double s = 0.1 * i;
    poses.emplace_back(
        std::cos(s), s, onlyYaw ? 0.0 : 0.3 * std::sin(2 * s), 0.8 * s,
        onlyYaw ? 0.0 : 0.4 * std::sin(s), onlyYaw ? 0.0 : 0.3 * std::cos(1.3 * s));
  }
  return poses;
}

/** The poses of a left-handed world: y negated on both sides, by matrices of 4x4. */
CPose3D leftHanded(const CPose3D& pose, const Eigen::Vector4d& body)
{
  const Eigen::Matrix4d T = Eigen::Vector4d(1, -1, 1, 1).asDiagonal() *
                            pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen() *
                            body.asDiagonal();
  return CPose3D(mrpt::math::CMatrixDouble44(T));
}

const Eigen::Vector4d kOptical(1, -1, 1, 1), kRobot(1, 1, -1, 1);

/** Pairs of a walk with noise, in the frame of an estimate that lies elsewhere.
 * \param truthOf Makes the true pose of a robot's. */
template <typename TruthOf>
std::vector<PosePair> pairsOf(const std::vector<CPose3D>& poses, const TruthOf& truthOf)
{
  RandomGeometry random(5);
  const CPose3D T_map_world(3, -2, 1, 0.7, 0, 0);
  std::vector<PosePair> pairs;
  for (const CPose3D& pose : poses)
  {
    const Eigen::Vector3d turn = random.vector(-0.01, 0.01);
    const CPose3D noise(0.01, 0, 0, turn.x(), turn.y(), turn.z());
    pairs.push_back(
        {truthOf(pose), T_map_world + pose + noise, 0.1 * static_cast<double>(pairs.size())});
  }
  return pairs;
}
}  // namespace

TEST(TruthReflection, RightHandedTruthStaysAsItIs)
{
  for (const bool onlyYaw : {false, true})
  {
    const auto poses = walk(onlyYaw);
    EXPECT_FALSE(reflectionOfTruth(pairsOf(poses, [](const CPose3D& p) { return p; })));
    EXPECT_FALSE(
        reflectionOfTruth(pairsOf(poses, [](const CPose3D& p) { return p + T_sensor_optical(); })));
    const CPose3D backwards(0, 0, 0, M_PI, 0, 0);
    EXPECT_FALSE(reflectionOfTruth(pairsOf(poses, [&](const CPose3D& p) { return p + backwards; })))
        << "the turns of a body that faces backwards are those of a left-handed one";
    EXPECT_FALSE(reflectionOfTruth(
        pairsOf(poses, [&](const CPose3D& p) { return p + backwards + T_sensor_optical(); })));
  }
  EXPECT_FALSE(reflectionOfTruth({}));
}

TEST(TruthReflection, LeftHandedTruthIsKnownByItsTurns)
{
  const auto poses = walk(false);
  const auto optical = [](const CPose3D& p)
  { return leftHanded(p + T_sensor_optical(), kOptical); };
  const auto reflection = reflectionOfTruth(pairsOf(poses, optical));
  ASSERT_TRUE(reflection);
  EXPECT_LT(((*reflection)(optical(poses[7])) - (poses[7] + T_sensor_optical())).norm(), 1e-9);
  const auto robot = [](const CPose3D& p) { return leftHanded(p, kRobot); };
  const auto ofRobot = reflectionOfTruth(pairsOf(poses, robot));
  ASSERT_TRUE(ofRobot);
  EXPECT_LT(((*ofRobot)(robot(poses[7])) - poses[7]).norm(), 1e-9);
}

TEST(TruthReflection, TurnsAboutOneAxisDoNotTell)
{
  const auto pairs = pairsOf(walk(true), [](const CPose3D& p) { return leftHanded(p, kRobot); });
  EXPECT_FALSE(reflectionOfTruth(pairs));
}

TEST(TruthReflection, ReflectsCuboids)
{
  const Ellipsoid object(CPose3D(1, 2, 3, 0.5, 0, 0), {0.4, 0.2, 0.1});
  const Ellipsoid reflected = TruthReflection({1, -1, 1})(object);
  // Every corner of the one is, with y negated, a corner of the other.
  const auto corners = object.cuboidCorners(), others = reflected.cuboidCorners();
  for (Eigen::Index i = 0; i < corners.cols(); ++i)
  {
    const Eigen::Vector3d wanted = corners.col(i).cwiseProduct(Eigen::Vector3d(1, -1, 1));
    EXPECT_LT((others.colwise() - wanted).colwise().norm().minCoeff(), 1e-9);
  }
}
