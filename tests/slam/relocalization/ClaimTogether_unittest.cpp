#include "relocalization/ClaimTogether.h"

#include <gtest/gtest.h>

using namespace quadmap;
using mrpt::poses::CPose3D;

namespace
{
/** \param sigma Of all numbers of its state [m], [rad], [-]. */
MapObject boxOf(double sigmaX, double sigmaY)
{
  MapObject object;
  object.object = Ellipsoid(CPose3D(1.0, -2.0, 0.3, 0.4, 0, 0), {0.4, 0.2, 0.3});
  object.covariance = 1e-4 * UprightCovariance::Identity();
  object.covariance(0, 0) = sigmaX * sigmaX;
  object.covariance(1, 1) = sigmaY * sigmaY;
  object.labelCounts = {
      {"suitcase", 10}
  };
  object.completeCount = 10;
  return object;
}

/** What the heir claims after two objects of a run, in this order, became one. */
UprightCovariance claimOfHeir(const MapObject& first, const MapObject& second)
{
  CQuadricObjectMap own, map;
  const ObjectId a = own.addObject(first), b = own.addObject(second);
  const ObjectId heir = map.addObject(boxOf(0.01, 0.01));
  claimTogether(
      CQuadricObjectMap(), own,
      {
          {a, heir},
          {b, heir}
  },
      map);
  return map.find(heir)->covariance;
}
}  // namespace

TEST(ClaimTogether, TheOrderOfTwoObjectsWithOneHeirPlaysNoPart)
{
  const MapObject sure = boxOf(0.05, 0.05), unsure = boxOf(0.3, 0.3);
  const UprightCovariance one = claimOfHeir(sure, unsure), other = claimOfHeir(unsure, sure);
  EXPECT_LT((one - other).norm(), 1e-6);
  EXPECT_NEAR(std::sqrt(one(0, 0)), 0.05, 0.01) << "the better one is known";
}

TEST(ClaimTogether, TwoObjectsWithOneHeirComplementEachOther)
{
  const UprightCovariance claim = claimOfHeir(boxOf(0.02, 0.5), boxOf(0.5, 0.02));
  EXPECT_LT(std::sqrt(claim(0, 0)), 0.1);
  EXPECT_LT(std::sqrt(claim(1, 1)), 0.1);
  EXPECT_GT(std::sqrt(claim(0, 0)), 0.02) << "but are not independent";
}
