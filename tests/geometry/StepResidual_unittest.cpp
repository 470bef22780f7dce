#include "quadmap/geometry/StepResidual.h"

#include <gtest/gtest.h>

using namespace quadmap;

namespace
{
using InSpace = RotationAndTranslation<Eigen::Quaterniond, Eigen::Vector3d>;
using InPlane = RotationAndTranslation<Eigen::Rotation2Dd, Eigen::Vector2d>;
}  // namespace

TEST(StepResidual, IsZeroWhenTheStepIsTheMeasuredOne)
{
  const InSpace from{
      rotationOf({0.3, -0.2, 0.9}
      ), {  1,    2,   3}
  };
  const InSpace step{
      rotationOf({-0.1,  0.4, 0.2}
      ), { 0.5, -0.1, 0.2}
  };
  const InSpace to{from.R * step.R, from.t + from.R * step.t};
  EXPECT_LT(stepResidual(from, to, step).norm(), 1e-14);
}

TEST(StepResidual, HasTheShiftAlongTheFirstPoseAndTheTurnAlongTheSecond)
{
  const InSpace from{
      rotationOf({0.3, -0.2, 0.9}
      ), {  1,    2,   3}
  };
  const InSpace step{
      rotationOf({-0.1,  0.4, 0.2}
      ), { 0.5, -0.1, 0.2}
  };
  const Eigen::Vector3d shift(0.01, 0.02, -0.03), turn(0.02, -0.01, 0.03);
  const InSpace to{from.R * step.R * rotationOf(turn), from.t + from.R * (step.t + shift)};
  const Eigen::Matrix<double, 6, 1> e = stepResidual(from, to, step);
  EXPECT_LT((e.head<3>() - shift).norm(), 1e-14);
  EXPECT_LT((e.tail<3>() - turn).norm(), 1e-14);
}

TEST(StepResidual, TurnsInThePlaneTheShorterWayRound)
{
  const InPlane from{
      Eigen::Rotation2Dd(3.1), {1, 2}
  },
      step{Eigen::Rotation2Dd(0.1), {0, 0}};
  const InPlane to{
      Eigen::Rotation2Dd(-3.0), {1, 2}
  };
  const Eigen::Vector3d e = stepResidual(from, to, step);
  EXPECT_LT(e.head<2>().norm(), 1e-14);
  EXPECT_NEAR(e[2], 2 * M_PI - 6.2, 1e-12);
}
