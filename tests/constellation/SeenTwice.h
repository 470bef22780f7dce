#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "../obs/InstalledLabels.h"
#include "quadmap/constellation/Doubles.h"
#include "quadmap/geometry/RotationVector.h"

namespace quadmap
{
/** Position of a robot that goes along x and back, one keyframe each half metre [m]. */
inline Eigen::Vector3d robotAt(std::size_t keyframe)
{
  constexpr std::size_t kLast = 40;
  return {0.5 * static_cast<double>(std::min(keyframe, kLast - keyframe)), 0, 0};
}

/** Each step of that robot errs by 5 cm and 1 degree about the place where it ends, times a factor.
 * The sum goes over the steps that both things have in common. */
class DriftOfItsSteps : public Drift
{
 public:
  explicit DriftOfItsSteps(double factor) : factor_(factor) {}

  Eigen::Matrix3d covariance(const Moved& a, const Moved& b) const override
  {
    constexpr double kShift = 0.05, kTurn = 0.0173;  // [m], [rad]
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    const std::size_t last = std::min(a.again, b.again);
    for (std::size_t k = std::max(a.before, b.before) + 1; k <= last; ++k)
      sum += kShift * kShift * Eigen::Matrix3d::Identity() +
             kTurn * kTurn * crossMatrix(a.place - robotAt(k)) *
                 crossMatrix(b.place - robotAt(k)).transpose();
    return factor_ * factor_ * sum;
  }

 private:
  double factor_;
};

/** What that robot sees: when it sets out and again when it is back. */
class SeenTwice
{
 public:
  using Keyframes = std::set<std::size_t>;

  /** An object that some keyframes saw. */
  ObjectId add(const std::string& label, const Eigen::Vector3d& center, const Keyframes& by)
  {
    MapObject& object = objects_.emplace_back();
    object.id = static_cast<ObjectId>(sighted_.size());
    object.object = Ellipsoid(
        mrpt::poses::CPose3D(center.x(), center.y(), center.z(), 0, 0, 0), {0.08, 0.08, 0.3});
    object.covariance = 1e-4 * UprightCovariance::Identity();
    object.labelCounts[label] = 10;
    sighted_.push_back({&object, {}, *by.begin()});
    for (const std::size_t k : by) addSighting(object.id, k);
    return object.id;
  }

  void addSighting(ObjectId id, std::size_t keyframe)
  {
    SightedObject& seen = sighted_.at(id);
    const auto distance = [&](std::size_t k)
    { return (robotAt(k) - seen.object->object.center()).norm(); };
    seen.keyframes.insert(keyframe);
    if (distance(keyframe) < distance(seen.nearest)) seen.nearest = keyframe;
  }

  std::vector<DoublesCandidate> candidates(double drift = 1) const
  {
    return doublesCandidates(rules(), DriftOfItsSteps(drift));
  }

  std::optional<Doubles> doublesAmong(
      const std::vector<DoublesCandidate>& candidates,
      double drift = 1,
      const std::function<bool()>& shouldStop = [] { return false; }) const
  {
    return findDoubles(rules(), candidates, DriftOfItsSteps(drift), shouldStop);
  }

  std::optional<Doubles> doubles(double drift = 1) const
  {
    return doublesAmong(candidates(drift), drift);
  }

 private:
  DoublesRules rules() const { return {sighted_, labels(), options_}; }

  ConstellationOptions options_;
  std::deque<MapObject> objects_;
  std::vector<SightedObject> sighted_;  // by id
};

}  // namespace quadmap
