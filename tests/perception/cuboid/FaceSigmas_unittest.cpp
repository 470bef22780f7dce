#include "cuboid/FaceSigmas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "../../surfaces/SyntheticFrame.h"
#include "quadmap/geometry/Plane.h"
#include "quadmap/perception/FramePerception.h"

namespace quadmap
{
namespace
{
/** Residuals of faces at the truth, in units of the sigmas they claim. */
struct Residuals
{
  double count = 0, sum = 0, squares = 0, violated = 0, inequalities = 0;

  double mean() const { return sum / count; }
  double variance() const { return squares / count - mean() * mean(); }

  void add(const CompleteMeasurement& m, const Ellipsoid& truth_sensor)
  {
    const Eigen::Matrix3d R = m.object_sensor.rotation();
    for (std::size_t f = 0; f < kFaces; ++f)
    {
      const auto axis = static_cast<Eigen::Index>(f / 2);
      const Eigen::Vector3d n = (f % 2 == 0 ? 1.0 : -1.0) * R.col(axis);
      const Plane inwards{-n, n.dot(m.object_sensor.center()) + m.object_sensor.semiAxes()[axis]};
      const double half = std::sqrt(n.dot(truth_sensor.shapeMatrix() * n));
      const double gap = inwards.signedDistance(truth_sensor.center()) - half;
      const double r = gap / m.faces[f].sigma;
      if (m.faces[f].kind == FaceKind::AtLeast)
      {
        ++inequalities;
        violated += r > 3 ? 1 : 0;
        continue;
      }
      ++count;
      sum += r;
      squares += r * r;
    }
  }
};

/** Measures box 0 of a frame with depth noise. */
void addBox(SyntheticFrame& frame, Residuals& out, const std::string& label = "suitcase")
{
  static const LabelTable labels = LabelTable::installed();
  frame.noise = 0.0019;
  CObservationObjects boxes = frame.observation({frame.detect(0, label)});
  FramePerception(PerceptionOptions(), labels).measure(frame.scan(), boxes, frame.up_sensor());
  const auto& m = boxes.objects.front().measurement;
  if (!m.complete) return;
  out.add(*m.complete, frame.boxes[0].cuboid.transformed(-frame.T_world_sensor));
}

/** Mean of the n-th largest (0: the largest) of some normally distributed values of variance 1. */
double meanOfLargest(std::size_t n, std::size_t count)
{
  constexpr int kTrials = 20000;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  double sum = 0;
  for (int i = 0; i < kTrials; ++i)
  {
    std::vector<double> values(count);
    for (auto& v : values) v = normal(random);
    const auto nth = values.begin() + static_cast<long>(n);
    std::nth_element(values.begin(), nth, values.end(), std::greater<>());
    sum += *nth;
  }
  return sum / kTrials;
}

TEST(FaceSigmas, NoiseMovesTheOutermostPointsAsFarAsDrawnOnesLie)
{
  for (const std::size_t count : {3, 8, 25, 120})
    for (std::size_t n = 0; n < 3; ++n)
      EXPECT_NEAR(outlineNoise(-1.0, 1.0, n, count), meanOfLargest(n, count), 0.05)
          << n << " of " << count;
}

TEST(FaceSigmas, NoiseAlongTheLineOfSightOnlyMovesPoints)
{
  EXPECT_DOUBLE_EQ(outlineNoise(0.1, 0.01, 0, 10), 0.0);
  EXPECT_NEAR(outlineNoise(0.5, 0.01, 0, 10), 0.5 * outlineNoise(1.0, 0.01, 0, 10), 1e-12);
}

TEST(FaceSigmas, HoldForABoxFromManyRangesAndAngles)
{
  Residuals residuals;
  for (const double range : {1.5, 2.2, 3.0})
    for (const double yaw_deg : {-35.0, -18.0, 7.0, 22.0, 41.0, 60.0})
    {
      SyntheticFrame frame(1.4, range < 2 ? 0.6 : 0.4);
      frame.add(range, 0.1, 0.0, yaw_deg * M_PI / 180, {0.5, 0.4, 0.6});
      addBox(frame, residuals);
    }
  ASSERT_GT(residuals.count, 70) << "18 views of at least four faces";
  // Three sigmas of the mean and of the variance of that many independent residuals; a box is the
  // easiest thing to measure, so its residuals may be smaller than those of furniture.
  EXPECT_NEAR(residuals.mean(), 0.0, 0.36);
  EXPECT_LT(residuals.variance(), 1.4);
  EXPECT_GT(residuals.variance(), 0.2);
  EXPECT_EQ(residuals.violated, 0) << "of " << residuals.inequalities;
}

TEST(FaceSigmas, NeverClaimTooMuchForObjectsThatAreCut)
{
  Residuals residuals;
  for (const double left : {0.55, 0.75, 0.95})  // cut by the image's border
  {
    SyntheticFrame frame(1.4, 0.5);
    frame.add(1.7, left, 0.0, 0.2, {0.5, 0.9, 0.6});
    addBox(frame, residuals);
  }
  for (const double width : {0.2, 0.35, 0.5})  // cut by something in front of it
  {
    SyntheticFrame frame(1.4, 0.4);
    frame.add(2.4, 0.0, 0.0, 0.1, {0.5, 1.0, 0.6});
    frame.add(1.5, 0.35, 0.0, 0.0, {0.2, width, 0.9});
    addBox(frame, residuals);
  }
  ASSERT_GE(residuals.inequalities, 6);
  EXPECT_EQ(residuals.violated, 0);
}

}  // namespace
}  // namespace quadmap
