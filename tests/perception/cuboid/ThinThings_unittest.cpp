#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

#include "../../surfaces/SyntheticFrame.h"
#include "quadmap/perception/FramePerception.h"

// Things about as thin as what parts an object from its support (doc/mathematics.md, 6 and 8).

namespace quadmap
{
namespace
{
constexpr double kTable = 0.7;  // height of its top [m]
constexpr std::size_t kTop = 4, kBottom = 5, kSides = 4;

/** Something on a table 1.3 m ahead, seen from above. */
ObjectMeasurement measured(const char* label, const Eigen::Vector3d& size, double yaw)
{
  SyntheticFrame frame(1.3, 0.65);
  frame.noise = 0.0015;
  frame.add(1.4, 0.0, 0.0, 0.0, {0.9, 1.4, kTable});
  frame.add(1.3, 0.1, kTable, yaw, size);
  CObservationObjects boxes = frame.observation({frame.detect(1, label)});
  const auto scan = frame.scan();
  FramePerception(PerceptionOptions(), LabelTable::installed())
      .measure(scan, boxes, frame.up_sensor());
  return boxes.objects.front().measurement;
}

TEST(ThinThings, LieOnWhatShowsAllAroundThem)
{
  for (const double thickness : {0.016, 0.02, 0.03})
    for (const double yaw : {0.0, 0.4})
    {
      const auto m = measured("book", {0.22, 0.31, thickness}, yaw);
      ASSERT_TRUE(m.complete) << thickness << " " << yaw << ": " << m.reason;
      EXPECT_EQ(m.complete->faces[kBottom].kind, FaceKind::Support) << thickness << " " << yaw;
      EXPECT_EQ(m.complete->faces[kTop].kind, FaceKind::Measured) << thickness << " " << yaw;
      EXPECT_NEAR(2 * m.complete->object_sensor.semiAxes().z(), thickness, 0.005) << yaw;
    }
}

/** The rim of a thin thing is taken for the table, hence no side is known; that of a thick one is.
 */
TEST(ThinThings, HaveNoSidesOfTheirOwn)
{
  const auto measuredSides = [](double thickness, double yaw)
  {
    const auto m = measured("book", {0.22, 0.31, thickness}, yaw);
    if (!m.complete) return std::ptrdiff_t{0};
    const auto first = m.complete->faces.begin();
    return std::count_if(
        first, first + kSides, [](const auto& face) { return face.kind == FaceKind::Measured; });
  };
  std::ptrdiff_t thin = 0, thick = 0;
  for (const double yaw : {0.0, 0.2, 0.4, 0.6})
  {
    thin += measuredSides(0.018, yaw);
    thick += measuredSides(0.06, yaw);
  }
  EXPECT_EQ(thin, 0);
  EXPECT_GE(thick, 8);
}
}  // namespace
}  // namespace quadmap
