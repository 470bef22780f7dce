#include "quadmap/estimation/ViewAtPose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "quadmap/estimation/LabelPrior.h"
#include "quadmap/geometry/RotationVector.h"

using namespace quadmap;
using Eigen::Vector3d;

namespace
{
/** What the rows depend on. */
struct State
{
  RobotPose pose;
  UprightState upright;  // of the upright object
  Eigen::Matrix3d R;     // of the free object
  ObjectFreedom freedom = ObjectFreedom::Upright;

  ObjectShape object() const
  {
    if (freedom == ObjectFreedom::Upright) return ObjectShape(upright);
    return {upright.head<3>(), R, upright.tail<3>().array().exp()};
  }

  /** Moved by h along one increment: 0..5 the pose's (w, d), 6..14 the object's (d, w, d ln s). */
  State moved(int i, double h) const
  {
    State m = *this;
    const Vector3d step = h * Vector3d::Unit(i % 3);
    if (i < 3) m.pose.R = rotationOf(step).toRotationMatrix() * pose.R;
    if (i >= 3 && i < 6) m.pose.t += step;
    if (i >= 6 && i < 9) m.upright.head<3>() += step;
    if (i >= 9 && i < 12) m.R = rotationOf(step).toRotationMatrix() * R;
    if (i == 11) m.upright[3] += h;
    if (i >= 12) m.upright.tail<3>() += step;
    return m;
  }

  /** An upright object turns about the vertical alone. */
  bool has(int i) const { return freedom == ObjectFreedom::Free || (i != 9 && i != 10); }
};

State stateOf(ObjectFreedom freedom)
{
  State s;
  s.freedom = freedom;
  s.pose = {
      rotationOf({0.1, -0.2, 0.7}
      ).toRotationMatrix(), {0.3, -0.4, 0.1}
  };
  s.upright << 1.6, 0.5, 0.4, 0.9, std::log(0.4), std::log(0.25), std::log(0.6);
  s.R = rotationOf({0.12, -0.08, 0.9}).toRotationMatrix();
  return s;
}

BoxMeasurement measurement()
{
  BoxMeasurement m;
  m.camera = {0.1, -0.05, 1.2};
  m.center = {1.5, -0.2, 0.3};
  m.complete = m.yawDefined = m.hasSeed = true;
  m.yawSigma = 0.05;
  m.tiltSigma = 0.02;
  m.halfSizes = {0.5, 0.3, 0.7};
  for (auto& face : m.faces) face = {FaceKind::Measured, 0.02};
  m.faces[1].kind = FaceKind::AtLeast;
  m.faces[4].kind = FaceKind::Unknown;
  m.faceExponent = 1.4;
  m.axes = rotationOf({0.04, 0.03, 0.3}).toRotationMatrix();
  m.edges = {
      {Vector3d(0.3,  0.9, 0.1).normalized(), 0.03},
      {Vector3d(0.2, -0.4, 0.8).normalized(), 0.04}
  };
  m.seedWhitening << 3, 0.2, 0.1, -0.4, 2, 0.3, 0.5, -0.1, 4;
  return m;
}

ViewAtPose viewAt(const BoxMeasurement& m, const State& s)
{
  return {m, s.pose, s.freedom, RowDerivatives::OfObjectAndPose};
}

Eigen::Matrix<double, 15, 1> derivativesOf(const ResidualRow& row)
{
  Eigen::Matrix<double, 15, 1> d;
  d << row.byPose().transpose(), row.byFreeObject().transpose();
  return d;
}

using RowAt = std::function<ResidualRow(const State&)>;

/** One kind of row. */
struct Kind
{
  std::string name;
  RowAt rowAt;
  bool ofUpright = true, ofFree = true;
};

std::vector<Kind> kinds(const BoxMeasurement& m)
{
  std::vector<Kind> all;
  for (std::size_t f = 0; f < kFaces; ++f)
    all.push_back({"face", [&m, f](const State& s) { return viewAt(m, s).face(f, s.object()); }});
  all.push_back(
      {"yaw", [&m](const State& s) { return viewAt(m, s).yaw(s.object()); }, true, false});
  for (int i = 0; i < 2; ++i)
    all.push_back({"tilt", [&m, i](const State& s) { return viewAt(m, s).tilt(i); }, true, false});
  for (int i = 0; i < 3; ++i)
    all.push_back(
        {"turn", [&m, i](const State& s) { return viewAt(m, s).turn(i, s.object()); }, false,
         true});
  for (const double q : {1.05, 1.5, 2.0})
    for (const auto& e : m.edges)
      all.push_back(
          {"edge", [&m, e, q](const State& s) { return viewAt(m, s).edge(e, s.object(), q); }});
  for (int i = 0; i < 3; ++i)
    all.push_back({"seed", [&m, i](const State& s) { return viewAt(m, s).seed(i, s.object()); }});
  for (std::size_t i = 0; i < kLabelPriorRows; ++i)
    all.push_back(
        {"label", [i](const State& s)
         {
           LabelProperties label;
           label.typicalSize = {1.4, 0.9, 0.75};
           label.sizeSpread = 0.4;
           label.dominantDirection = false;
           return labelPriorRows(s.upright.tail<3>(), label, EstimatorOptions())[i];
         }});
  // The same tangency without a measurement: the baseline's edges.
  all.push_back(
      {"plane of the map", [](const State& s)
       {
         const Vector3d n = Vector3d(0.5, 0.2, -0.6).normalized();
         return tangencyRow(n, n.dot(s.object().t) + 0.3, s.object(), 2.0);
       }});
  return all;
}

}  // namespace

TEST(ViewAtPose, DerivativesOfAllRowsAreThoseOfTheResiduals)
{
  constexpr double h = 1e-6;
  const BoxMeasurement m = measurement();
  for (const auto freedom : {ObjectFreedom::Upright, ObjectFreedom::Free})
    for (const Kind& kind : kinds(m))
    {
      if (!(freedom == ObjectFreedom::Upright ? kind.ofUpright : kind.ofFree)) continue;
      const State state = stateOf(freedom);
      const auto analytic = derivativesOf(kind.rowAt(state));
      for (int i = 0; i < 15; ++i)
      {
        if (!state.has(i)) continue;
        const double numeric =
            (kind.rowAt(state.moved(i, h)).r - kind.rowAt(state.moved(i, -h)).r) / (2 * h);
        EXPECT_NEAR(analytic[i], numeric, 1e-7 * (1 + std::abs(numeric)))
            << kind.name << ", increment " << i << (freedom == ObjectFreedom::Free ? ", free" : "");
      }
    }
}

TEST(ViewAtPose, GivesAsManyRowsAsItSays)
{
  for (const auto freedom : {ObjectFreedom::Upright, ObjectFreedom::Free})
    for (const bool complete : {true, false})
      for (const bool yawDefined : {true, false})
        for (const double tiltSigma : {0.0, 0.02})
        {
          BoxMeasurement m = measurement();
          m.complete = complete;
          m.yawDefined = yawDefined;
          m.hasSeed = !complete;
          m.tiltSigma = tiltSigma;
          std::size_t count = 0;
          const State s = stateOf(freedom);
          viewAt(m, s).forEachRow(
              s.object(), 1.3, {1.5},
              [&](const ResidualRow&, double sigma, const RobustKernel&)
              {
                EXPECT_GT(sigma, 0);
                ++count;
              });
          EXPECT_EQ(count, ViewAtPose::rowCount(m, freedom));
        }
}

TEST(ViewAtPose, EdgesThatContradictLetGo)
{
  BoxMeasurement m = measurement();
  m.complete = m.hasSeed = false;
  ASSERT_FALSE(m.edges.empty());
  const State s = stateOf(ObjectFreedom::Upright);
  const auto pullOfFirst = [&](const RowKernels& kernels, double sigma)
  {
    m.edges.resize(1);
    m.edges[0].sigma = sigma;
    double pull = 0;
    viewAt(m, s).forEachRow(
        s.object(), 1.3, kernels,
        [&](const ResidualRow& row, double, const RobustKernel& kernel)
        { pull = std::abs(kernel.weight(row.r / sigma) * row.r / sigma); });
    return pull;
  };
  double gap = 0;
  viewAt(m, s).forEachRow(
      s.object(), 1.3, {1.5},
      [&](const ResidualRow& row, double, const RobustKernel&)
      {
        if (gap == 0) gap = std::abs(row.r);
      });
  ASSERT_GT(gap, 0);
  EXPECT_LT(pullOfFirst({1.5, true}, gap / 20), 0.25 * pullOfFirst({1.5, true}, gap / 2));
  EXPECT_DOUBLE_EQ(pullOfFirst({1.5, false}, gap / 20), 1.5);
}

TEST(ViewAtPose, WithoutThePosesDerivativesTheRestIsTheSame)
{
  const BoxMeasurement m = measurement();
  for (const auto freedom : {ObjectFreedom::Upright, ObjectFreedom::Free})
  {
    const State s = stateOf(freedom);
    std::vector<ResidualRow> all, ofObject;
    viewAt(m, s).forEachRow(
        s.object(), 1.3, {1.5},
        [&](const ResidualRow& row, double, const RobustKernel&) { all.push_back(row); });
    ViewAtPose(m, s.pose, freedom, RowDerivatives::OfObject)
        .forEachRow(
            s.object(), 1.3, {1.5},
            [&](const ResidualRow& row, double, const RobustKernel&) { ofObject.push_back(row); });
    ASSERT_EQ(all.size(), ofObject.size());
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      EXPECT_EQ(all[i].r, ofObject[i].r);
      EXPECT_EQ(all[i].byFreeObject(), ofObject[i].byFreeObject());
      EXPECT_EQ(ofObject[i].byPose().norm(), 0);
    }
  }
}
