#include "quadmap/obs/Plausible.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

CPose3D withRotation(const Eigen::Matrix3d& R)
{
  CPose3D pose(1, 2, 3, 0, 0, 0);
  pose.setRotationMatrix(mrpt::math::CMatrixDouble33(R));
  return pose;
}

/** The reason, "" when there is none. */
std::string textOf(const std::optional<std::string>& why) { return why.value_or(""); }

void expectPart(const std::optional<std::string>& why, const std::string& part)
{
  EXPECT_NE(textOf(why).find(part), std::string::npos) << part << " is not in: " << textOf(why);
}
}  // namespace

TEST(Plausible, PosesAreRotationsNotTooFarAway)
{
  EXPECT_EQ(textOf(whyNoPose(CPose3D(1e8, 0, 0, 1, 0.2, 3))), "");
  EXPECT_EQ(textOf(whyNoPose(CPose3D(600, 800, 0, 0, 0, 0), kFarthestOnRobot)), "");
  expectPart(whyNoPose(CPose3D(1.1e8, 0, 0, 0, 0, 0)), "is 1.1e+08 m away, which is absurd");
  expectPart(whyNoPose(CPose3D(0, 1001, 0, 0, 0, 0), kFarthestOnRobot), "is 1001 m away");
  expectPart(whyNoPose(CPose3D(0, 0, kNaN, 0, 0, 0)), "not finite");
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  EXPECT_EQ(textOf(whyNoPose(withRotation(1.0001 * I))), "") << "files round";
  const Eigen::Vector3d mirror(-1, 1, 1);
  const Eigen::Matrix3d huge = Eigen::Matrix3d::Constant(1e300);
  for (const Eigen::Matrix3d& R :
       {Eigen::Matrix3d(0 * I), Eigen::Matrix3d(2 * I), Eigen::Matrix3d(0.5 * I), huge,
        Eigen::Matrix3d(mirror.asDiagonal())})
    expectPart(whyNoPose(withRotation(R)), "has no rotation");
  expectPart(whyNoPose(withRotation(kNaN * I)), "not finite");
}

TEST(Plausible, SizesAreThoseOfThings)
{
  EXPECT_EQ(textOf(whyNoSize({1e-6, 1, 1e4})), "");
  for (const double side : {0.0, -1.0, 1e-7, 1.1e4, 1e300, HUGE_VAL, kNaN})
    expectPart(whyNoSize({1, side, 1}), "not in [1e-06, 10000] m");
}

TEST(Plausible, ObjectsHaveAPoseAndASize)
{
  const Eigen::Vector3d one(1, 1, 1);
  EXPECT_EQ(textOf(whyNoObject(Ellipsoid(CPose3D(1, 2, 3, 0.4, 0, 0), one))), "");
  expectPart(whyNoObject(Ellipsoid(CPose3D(0, 0, 1e300, 0, 0, 0), one)), "is 1e+300 m away");
  expectPart(whyNoObject(Ellipsoid(CPose3D(), 1e5 * one)), "has a size that is 200000 m");
}

TEST(Plausible, CalibrationsProject)
{
  mrpt::img::TCamera good;
  good.ncols = 640;
  good.nrows = 480;
  good.setIntrinsicParamsFromValues(525, -525, 319.5, 239.5);  // fy as in ICL-NUIM
  EXPECT_EQ(textOf(whyNoCalibration(good)), "");
  const std::vector<std::pair<std::string, std::function<void(mrpt::img::TCamera&)>>> cases{
      {  "no camera calibration",      [](auto& c) { c.intrinsicParams(0, 0) = 0; }},
      {  "no camera calibration",   [](auto& c) { c.intrinsicParams(1, 2) = kNaN; }},
      {   "(focal length 1e-05,",   [](auto& c) { c.intrinsicParams(0, 0) = 1e-5; }},
      { "(focal length -1e+300,", [](auto& c) { c.intrinsicParams(1, 1) = -1e300; }},
      {          "centre 1e+300",  [](auto& c) { c.intrinsicParams(0, 2) = 1e300; }},
      {          "centre 100000",    [](auto& c) { c.intrinsicParams(1, 2) = 1e5; }},
      {"of distortion is 1e+300",                                           [](auto& c)
                                           {
                                           c.distortion = mrpt::img::DistortionModel::plumb_bob;
                                           c.dist[0] = 1e300;
                                           }      }
  };
  for (const auto& [part, spoil] : cases)
  {
    auto camera = good;
    spoil(camera);
    expectPart(whyNoCalibration(camera), part);
  }
}
