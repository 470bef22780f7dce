#pragma once

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "../geometry/Algebra.h"
#include "quadmap/points/PointSlam.h"

namespace quadmap
{
/** Options of a drifting robot in a room of similar things. The defaults are the hard case: fifteen
 * objects of five labels, with flipped labels, misses and clutter. */
struct PointWorldOptions
{
  std::size_t poses = 400;
  std::size_t objects = 15, labels = 5;
  double area = 12;              // side of the square room [m]
  double separation = 1.0;       // least distance of two objects [m]
  double stride = 0.2;           // distance from pose to pose [m]
  double range = 4.5;            // range of the sensor [m]
  double fieldOfView = 2.1;      // [rad]
  double sigma = 0.07;           // sigma of a measured position, per axis [m]
  double odometrySigma = 0.015;  // sigma of a step, per axis [m]
  double turnSigma = 0.012;      // sigma of a step, per axis [rad]
  double missShare = 0.10, flipShare = 0.05;
  double clutterShare = 0.25;  // share of all detections
};

/** The true poses of the robot, its odometry and its detections. */
template <int D>
class PointWorld
{
 public:
  explicit PointWorld(unsigned seed, const PointWorldOptions& options = {}) :
      options_(options), random_(seed)
  {
    placeObjects();
    walk(seed % 3);
    addOdometry();
    detect();
  }

  std::vector<PointVector<D>> objects;
  std::vector<std::string> labels;  // labels of the objects
  std::vector<PointPose<D>> truth;
  std::vector<PointOdometry<D>> odometry;  // step that leads to each pose; the first has none
  std::vector<std::vector<PointMeasurement<D>>>
      detections;                           // instance is the object; clutter has none
  std::vector<std::size_t> framesThatShow;  // number of frames, by object

  std::size_t detectionCount() const
  {
    std::size_t n = 0;
    for (const auto& frame : detections) n += frame.size();
    return n;
  }

  std::vector<PointPose<D>> drifted() const
  {
    std::vector<PointPose<D>> poses = {truth.front()};
    for (std::size_t k = 1; k < truth.size(); ++k)
      poses.push_back(poses.back() * odometry[k].T_from_to);
    return poses;
  }

  PointResult<D> solve(
      const PointOptions& options, bool finish = true, PointVisibility<D> visible = {}) const
  {
    PointSlam<D> slam(options, false, visible);
    for (std::size_t k = 0; k < truth.size(); ++k)
      slam.addFrame(odometry[k], detections[k], truth.front());
    if (finish) slam.finish();
    return slam.result();
  }

  bool isInView(const PointVector<D>& p_robot) const
  {
    const double bearing = std::atan2(p_robot.y(), p_robot.x());
    return p_robot.norm() < options_.range && p_robot.norm() > 0.4 &&
           std::abs(bearing) < options_.fieldOfView / 2;
  }

 private:
  double uniform(double from, double to)
  {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  double gauss(double sigma) { return std::normal_distribution<double>(0, sigma)(random_); }

  void placeObjects()
  {
    while (objects.size() < options_.objects)
    {
      PointVector<D> p;
      for (int i = 0; i < D; ++i) p[i] = i < 2 ? uniform(0, options_.area) : uniform(0, 1.8);
      bool isFree = true;
      for (const auto& other : objects) isFree &= (other - p).norm() > options_.separation;
      if (!isFree) continue;
      labels.push_back("label" + std::to_string(objects.size() % options_.labels));
      objects.push_back(p);
    }
    framesThatShow.assign(objects.size(), 0);
  }

  /** Next target of the robot: anywhere, round the room, or along an eight. */
  Eigen::Vector2d target(unsigned layout, std::size_t leg)
  {
    const double half = options_.area / 2, a = 2 * M_PI * static_cast<double>(leg) / 8;
    if (layout == 0) return {uniform(1, options_.area - 1), uniform(1, options_.area - 1)};
    const double radius = 0.75 * half;
    return layout == 1
               ? Eigen::Vector2d(half + radius * std::cos(a), half + radius * std::sin(a))
               : Eigen::Vector2d(half + radius * std::cos(a), half + radius * std::sin(2 * a));
  }

  void walk(unsigned layout)
  {
    constexpr double kMaxTurn = 0.25;  // per step [rad]
    Eigen::Vector2d p(options_.area / 4, options_.area / 4), goal = target(layout, 0);
    double heading = 0.5;
    for (std::size_t leg = 0; truth.size() < options_.poses;)
    {
      if ((goal - p).norm() < 1.0) goal = target(layout, ++leg);
      const Eigen::Vector2d way = goal - p;
      const double wanted = std::remainder(std::atan2(way.y(), way.x()) - heading, 2 * M_PI);
      heading += std::max(-kMaxTurn, std::min(kMaxTurn, wanted));
      p += options_.stride * Eigen::Vector2d(std::cos(heading), std::sin(heading));
      truth.push_back(poseAt(p, heading));
    }
  }

  PointPose<D> poseAt(const Eigen::Vector2d& p, double heading)
  {
    PointPose<D> pose;
    pose.t.template head<2>() = p;
    TurnVector<D> turn = TurnVector<D>::Zero();
    turn[turn.size() - 1] = heading;
    pose.R = rotationBy<D>(turn);
    if constexpr (D == 3)
    {
      pose.t.z() = 0.8 + gauss(0.03);
      pose.R = pose.R * rotationBy<3>(Eigen::Vector3d{gauss(0.03), gauss(0.03), 0});
    }
    return pose;
  }

  void addOdometry()
  {
    for (std::size_t k = 0; k < truth.size(); ++k)
    {
      PointOdometry<D> step;
      step.covariance.setZero();
      for (int i = 0; i < kPoseIncrement<D>; ++i)
      {
        const double sigma = i < D ? options_.odometrySigma : options_.turnSigma;
        step.covariance(i, i) = sigma * sigma;
      }
      if (k > 0)
      {
        step.T_from_to = truth[k - 1].inverse() * truth[k];
        TurnVector<D> turn;
        for (int i = 0; i < D; ++i) step.T_from_to.t[i] += gauss(options_.odometrySigma);
        for (int i = 0; i < kTurn<D>; ++i) turn[i] = gauss(options_.turnSigma);
        step.T_from_to.R = step.T_from_to.R * rotationBy<D>(turn);
      }
      odometry.push_back(step);
    }
  }

  PointMeasurement<D> measured(const PointVector<D>& p_robot, const std::string& label)
  {
    PointMeasurement<D> z;
    for (int i = 0; i < D; ++i) z.position[i] = p_robot[i] + gauss(options_.sigma);
    z.covariance = options_.sigma * options_.sigma * PointMatrix<D>::Identity();
    z.label = label;
    return z;
  }

  void detect()
  {
    std::size_t shown = 0;
    detections.resize(truth.size());
    for (std::size_t k = 0; k < truth.size(); ++k)
      for (std::size_t i = 0; i < objects.size(); ++i)
      {
        const PointVector<D> p_robot = truth[k].inverse() * objects[i];
        if (!isInView(p_robot)) continue;
        ++framesThatShow[i];
        if (uniform(0, 1) < options_.missShare) continue;
        auto label = labels[i];
        if (uniform(0, 1) < options_.flipShare) label = anyLabel();
        detections[k].push_back(measured(p_robot, label));
        detections[k].back().instance = static_cast<std::uint32_t>(i);
        ++shown;
      }
    const auto clutter = static_cast<std::size_t>(
        double(shown) * options_.clutterShare / (1 - options_.clutterShare));
    for (std::size_t c = 0; c < clutter; ++c)
    {
      const auto k = static_cast<std::size_t>(uniform(0, double(truth.size()) - 0.5));
      detections[k].push_back(measured(anywhereInView(), anyLabel()));
    }
    for (auto& frame : detections) std::shuffle(frame.begin(), frame.end(), random_);
  }

  std::string anyLabel()
  {
    return "label" + std::to_string(std::uniform_int_distribution<std::size_t>(
                         0, options_.labels - 1)(random_));
  }

  PointVector<D> anywhereInView()
  {
    PointVector<D> p;
    do
    {
      for (int i = 0; i < D; ++i)
        p[i] = i < 2 ? uniform(-options_.range, options_.range) : uniform(-0.8, 1.0);
    } while (!isInView(p));
    return p;
  }

  PointWorldOptions options_;
  std::mt19937 random_;
};

/** The motion that carries estimated positions to the true ones, by least squares. */
template <int D>
PointPose<D> alignment(const std::vector<PointPose<D>>& from, const std::vector<PointPose<D>>& to)
{
  Eigen::MatrixXd a(D, from.size()), b(D, to.size());
  for (std::size_t k = 0; k < from.size(); ++k)
  {
    a.col(static_cast<Eigen::Index>(k)) = from[k].t;
    b.col(static_cast<Eigen::Index>(k)) = to[k].t;
  }
  const Eigen::MatrixXd T = rigidAlignment(a, b);
  return {T.topLeftCorner(D, D), T.topRightCorner(D, 1)};
}

/** Root mean square error of the positions after alignment [m]. */
template <int D>
double trajectoryError(
    const std::vector<PointPose<D>>& estimated, const std::vector<PointPose<D>>& truth)
{
  const auto T = alignment<D>(estimated, truth);
  double sum = 0;
  for (std::size_t k = 0; k < truth.size(); ++k)
    sum += (T * estimated[k].t - truth[k].t).squaredNorm();
  return std::sqrt(sum / static_cast<double>(truth.size()));
}

struct PointScore
{
  std::size_t truth = 0, estimated = 0, matched = 0;

  double precision() const { return double(matched) / double(estimated); }
  double recall() const { return double(matched) / double(truth); }
  PointScore& operator+=(const PointScore& other)
  {
    truth += other.truth;
    estimated += other.estimated;
    matched += other.matched;
    return *this;
  }
};

/** Counts objects with the right label within 0.3 m of the true ones. Objects in fewer than three
 * frames need not be found. */
template <int D>
PointScore scoreOf(const PointResult<D>& result, const PointWorld<D>& world)
{
  constexpr double kMatch = 0.3;
  const auto T = alignment<D>(result.poses, world.truth);
  PointScore score;
  std::set<std::size_t> found;
  for (const auto& object : result.objects)
  {
    if (!object.confirmed) continue;
    ++score.estimated;
    for (std::size_t i = 0; i < world.objects.size(); ++i)
      if ((T * object.position - world.objects[i]).norm() < kMatch &&
          object.label() == world.labels[i] && found.insert(i).second)
      {
        ++score.matched;
        break;
      }
  }
  for (std::size_t i = 0; i < world.objects.size(); ++i)
    if (world.framesThatShow[i] >= 3 || found.count(i)) ++score.truth;
  return score;
}

}  // namespace quadmap
