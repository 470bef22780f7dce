#pragma once

#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "quadmap/geometry/RotationVector.h"
#include "quadmap/graph/FactorGraph.h"

namespace quadmap::testing
{
/** Upright boxes on a floor, a robot that drives past them in a circle, and what it measures:
 * noise exactly as the factors say. */
class GraphWorld
{
 public:
  struct Size
  {
    int objects = 12, poses = 60;
    double radius = 3;    // of the circle [m]
    double circles = 1;   // how often it goes around
    double maxRange = 4;  // an object is seen up to here [m]
    double faceSigma = 0.02, yawSigma = 0.03, tiltSigma = 0.01;
    double stepSigma = 0.01, stepAngle = 0.005;  // of the odometry, per step [m], [rad]
    double claim = 1;                            // of it, as a share of these
  };

  explicit GraphWorld(unsigned seed) : GraphWorld(seed, Size()) {}
  GraphWorld(unsigned seed, const Size& size) : size_(size), random_(seed)
  {
    for (int i = 0; i < size.objects; ++i)
    {
      const double at = 2 * M_PI * i / size.objects;
      const double far = size.radius + (i % 2 == 0 ? 1.5 : -1.2);
      // Braces: values are drawn from left to right, whatever the compiler.
      const Eigen::Vector3d half{
          0.15 + 0.3 * uniform(), 0.15 + 0.3 * uniform(), 0.2 + 0.4 * uniform()};
      objects.emplace_back(
          mrpt::poses::CPose3D(far * std::cos(at), far * std::sin(at), half.z(), uniform(), 0, 0),
          half);
    }
    for (int k = 0; k < size.poses; ++k)
    {
      const double at = 2 * M_PI * size.circles * k / size.poses;
      truth.emplace_back(
          size.radius * std::cos(at), size.radius * std::sin(at), 0, at + M_PI / 2, 0, 0);
      odometry.push_back(k == 0 ? truth[0] : odometry.back() + step(k).mean);
    }
  }

  std::vector<Ellipsoid> objects;
  std::vector<mrpt::poses::CPose3D> truth, odometry;

  LabelProperties label() const
  {
    LabelProperties p;
    p.typicalSize = {0.6, 0.6, 0.8};
    p.sizeSpread = 1;
    p.support = UsualSupport::Floor;
    return p;
  }

  /** The graph of the whole drive, with known associations; object i has the id i + 1. */
  FactorGraph graph(const FactorGraphOptions& options)
  {
    FactorGraph g(options);
    for (std::size_t k = 0; k < truth.size(); ++k) add(g, k, odometry[k]);
    return g;
  }

  /** One more pose with its views; a new object starts where it was seen.
   *  \return Views. */
  std::size_t add(FactorGraph& g, std::size_t k, const mrpt::poses::CPose3D& guess)
  {
    g.addPose(guess);
    if (k > 0)
    {
      auto step = stepDistribution(odometry[k] - odometry[k - 1]);
      step.cov *= size_.claim * size_.claim;
      g.addStep(k - 1, k, step);
    }
    return addViews(g, k);
  }

  /** The views of a pose, as in add(). */
  std::size_t addViews(FactorGraph& g, std::size_t k)
  {
    std::size_t count = 0;
    for (std::size_t i = 0; i < objects.size(); ++i)
    {
      const auto id = static_cast<ObjectId>(i + 1);
      if (!visible(k, i)) continue;
      const BoxMeasurement v = view(k, i);
      if (!g.hasObject(id)) g.setObject(id, placed(v, g.pose(k)), label());
      g.addView(k, id, v);
      ++count;
    }
    return count;
  }

  /** What a view says the object is, from a pose. */
  static Ellipsoid placed(const BoxMeasurement& v, const mrpt::poses::CPose3D& T_map_robot)
  {
    const Eigen::Matrix3d R = T_map_robot.getRotationMatrix().asEigen();
    const Eigen::Vector3d c =
        Eigen::Vector3d(T_map_robot.x(), T_map_robot.y(), T_map_robot.z()) + R * v.center;
    const Eigen::Vector3d x = R * v.axes.col(0);
    return {mrpt::poses::CPose3D(c.x(), c.y(), c.z(), std::atan2(x.y(), x.x()), 0, 0), v.halfSizes};
  }

  bool visible(std::size_t k, std::size_t i) const
  {
    const auto c = fromRobot(k, i).center();
    return c.x() > 0.3 && c.head<2>().norm() < size_.maxRange && c.x() > std::abs(c.y());
  }

  BoxMeasurement view(std::size_t k, std::size_t i)
  {
    const Ellipsoid object = fromRobot(k, i);
    const Eigen::Matrix3d R = object.rotation();
    BoxMeasurement v;
    v.camera = {0, 0, 1};
    v.complete = v.yawDefined = true;
    v.yawSigma = size_.yawSigma;
    v.tiltSigma = size_.tiltSigma;
    const Eigen::Vector3d eye = R.transpose() * (v.camera - object.center());
    Eigen::Vector3d ends[2];
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side)
      {
        const double sign = side == 0 ? 1 : -1, half = object.semiAxes()[axis];
        const bool bottom = axis == 2 && side == 1;
        const bool seen = bottom || sign * eye[axis] > half;
        v.faces[static_cast<std::size_t>(2 * axis + side)] = {
            bottom ? FaceKind::Support
            : seen ? FaceKind::Measured
                   : FaceKind::AtLeast,
            size_.faceSigma};
        ends[side][axis] = half + (seen ? gauss(size_.faceSigma) : -half * (0.1 + 0.3 * uniform()));
      }
    v.halfSizes = 0.5 * (ends[0] + ends[1]);
    v.center = object.center() + 0.5 * R * (ends[0] - ends[1]);
    v.axes = rotationOf({gauss(size_.tiltSigma), gauss(size_.tiltSigma), gauss(size_.yawSigma)})
                 .toRotationMatrix() *
             R;
    return v;
  }

  mrpt::poses::CPose3DPDFGaussian stepDistribution(const mrpt::poses::CPose3D& mean) const
  {
    mrpt::poses::CPose3DPDFGaussian step(mean);
    for (int i = 0; i < 3; ++i)
    {
      step.cov(i, i) = size_.stepSigma * size_.stepSigma;
      step.cov(i + 3, i + 3) = size_.stepAngle * size_.stepAngle;
    }
    return step;
  }

  double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  double gauss(double sigma) { return std::normal_distribution<double>(0, sigma)(random_); }

 private:
  Ellipsoid fromRobot(std::size_t k, std::size_t i) const
  {
    return objects[i].transformed(-truth[k]);
  }

  mrpt::poses::CPose3DPDFGaussian step(int k)
  {
    const auto index = static_cast<std::size_t>(k);
    const mrpt::poses::CPose3D T = truth[index] - truth[index - 1];
    const double p = size_.stepSigma, a = size_.stepAngle;
    return stepDistribution(mrpt::poses::CPose3D{
        T.x() + gauss(p), T.y() + gauss(p), T.z() + gauss(p), T.yaw() + gauss(a),
        T.pitch() + gauss(a), T.roll() + gauss(a)});
  }

  Size size_;
  std::mt19937 random_;
};

/** Root mean square distance of positions; the first pose is common. */
template <typename PoseOf>
double positionError(const std::vector<mrpt::poses::CPose3D>& truth, const PoseOf& poseAt)
{
  double sum = 0;
  for (std::size_t k = 0; k < truth.size(); ++k)
    sum += std::pow(poseAt(k).distanceTo(truth[k]), 2) / static_cast<double>(truth.size());
  return std::sqrt(sum);
}

inline FactorGraphOptions plain()
{
  FactorGraphOptions options;
  options.floorSigma = 0;
  return options;
}

/** The drive as it happens: each pose is predicted from the last estimate, then the window is
 * optimised. */
inline FactorGraph driveOnline(GraphWorld& world, std::size_t window)
{
  FactorGraph graph(plain());
  for (std::size_t k = 0; k < world.truth.size(); ++k)
  {
    const mrpt::poses::CPose3D guess =
        k == 0 ? world.odometry[0]
               : graph.pose(k - 1) + (world.odometry[k] - world.odometry[k - 1]);
    world.add(graph, k, guess);
    graph.optimiseWindow(k < window ? 1 : k + 1 - window);
  }
  return graph;
}

}  // namespace quadmap::testing
