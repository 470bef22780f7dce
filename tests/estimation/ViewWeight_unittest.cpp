#include <gtest/gtest.h>

#include <cmath>

#include "quadmap/estimation/ViewResiduals.h"

using namespace quadmap;

TEST(ViewWeight, ACuboidThatIsTurnedSaysLittleThoughItLiesWithinTheObject)
{
  UprightState table;
  table << 0, 0, 0.37, 0.2, std::log(0.9), std::log(0.4), std::log(0.37);
  ObjectView view;
  view.complete = view.yawDefined = true;
  view.center = {0.1, 0.1, 0.37};
  view.halfSizes = {0.2, 0.2, 0.37};
  view.faces.fill({FaceKind::AtLeast, 0.03});
  const auto weightAt = [&](double yaw)
  {
    view.yaw = yaw;
    return viewWeight(view, table);
  };
  EXPECT_GT(weightAt(0.2), 0.99);
  EXPECT_GT(weightAt(0.2 + M_PI / 2), 0.99) << "the axes have other names";
  EXPECT_GT(weightAt(0.2 + 0.05), 0.99) << "an honest error";
  EXPECT_LT(weightAt(0.2 - 0.63), 0.05) << "a chair at the table";
  view.faces[0].kind = FaceKind::Measured;
  view.center = {0.1 + 0.7 * std::cos(0.2), 0.7 * std::sin(0.2), 0.37};
  EXPECT_GT(weightAt(0.2 - 0.2), 0.9) << "it agrees by a side, and its pose has drifted";
  view.faces[0].kind = FaceKind::AtLeast;
  view.center = {0.1, 0.1, 0.37};
  view.yawDefined = false;
  EXPECT_GT(weightAt(0.2 - 0.63), 0.99) << "without a heading";
}
