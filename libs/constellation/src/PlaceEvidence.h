#pragma once

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <optional>
#include <utility>
#include <vector>

#include "PlaceGuesses.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** The local objects in the map's frame, as they are placed by one guess. */
struct PlacedObjects
{
  PlacedObjects(const Constellations::Objects& local, const Place& at);

  Place place;
  std::vector<Eigen::Vector3d> centers;
  std::vector<Eigen::Matrix3d> covariances;  //!< Of the centres
};

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;  //!< (local, map), indices

/** What pairs of a local object and one of the map say of the place of the local frame:
 * doc/mathematics.md, (19.1) to (19.3). */
class PlaceEvidence
{
 public:
  /** \param local,map Must outlive this. */
  PlaceEvidence(
      const Constellations::Objects& local,
      const Constellations::Objects& map,
      const LabelTable& labels,
      const ConstellationOptions& options);

  /** What a pair may be off: chi^2 of three degrees of freedom, 99 %. */
  static constexpr double kGate = 11.34;

  /** Factor on sigmas while a place is only guessed from a pair. */
  static constexpr double kCoarseFactor = 2;

  /** ln of how much better "it is this one" explains where local object i is than "something like
   * it happens to be there", (19.2) and (19.3). It is 0 beyond the gate.
   * \param factor On the sigmas. */
  double of(const PlacedObjects& placed, std::size_t i, std::size_t j, double factor) const;

  /** Sum over the local objects of the best evidence that any object of the map gives. Several may
   * use the same one. */
  double coarse(const Place& place) const;

  /** The pairing with the most evidence, each object once. */
  Pairs pairsAt(const PlacedObjects& placed, double factor) const;

  /** How far apart the centres of a pair are, and how that depends on (shift, yaw). */
  struct Gap
  {
    Eigen::Vector3d d;              //!< From the local object to that of the map [m]
    Eigen::Matrix<double, 3, 4> J;  //!< Derivative of where the local object is
    Eigen::Matrix3d S;              //!< Covariance of d, (19.1)
  };
  Gap gap(const PlacedObjects& placed, std::size_t i, std::size_t j) const;

  /** Weighted least squares of (shift, yaw) over pairs. */
  struct Normal
  {
    Eigen::Matrix4d H = Eigen::Matrix4d::Zero();
    Eigen::Vector4d g = Eigen::Vector4d::Zero();

    struct Solution
    {
      Eigen::Vector4d step;
      Eigen::Matrix4d covariance;
    };
    /** Nothing when the pairs fix no place, as one object without a heading does. */
    std::optional<Solution> solved() const;
  };
  Normal normalEquations(const PlacedObjects& placed, const Pairs& pairs) const;

  /** The place moved to where its pairs agree best. It stays where they fix none. */
  Place improved(const Place& place, const Pairs& pairs) const;

  const Constellations& both() const { return both_; }
  const Eigen::AlignedBox2d& bounds() const { return bounds_; }  //!< Of the map [m]

 private:
  Eigen::Vector3d offset(const PlacedObjects& placed, std::size_t i, std::size_t j) const;
  Eigen::Matrix3d covariance(const PlacedObjects& placed, std::size_t i, std::size_t j) const;
  double yawVariance(std::size_t i, std::size_t j) const;
  double yawOffset(const Place& place, std::size_t i, std::size_t j) const;

  const ConstellationOptions& options_;
  Constellations both_;
  Eigen::AlignedBox2d bounds_;
  std::vector<double> logDensity_;  //!< Of objects with its label, for each of the map [ln 1/m^2]
};

}  // namespace quadmap
