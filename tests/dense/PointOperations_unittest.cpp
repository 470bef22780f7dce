#include "PointOperations.h"

#include <gtest/gtest.h>

using namespace quadmap;

TEST(PointOperations, CompareAsManyPointsAsThereAre)
{
  pointOperations::Points points;
  for (std::size_t count = 0; count < 6; ++count)
  {
    EXPECT_EQ(pointOperations::withoutOutliers(points, 1000, 2.5).size(), count);
    points.emplace_back(0.01F * static_cast<float>(count), 0, 0);
  }
}
