#pragma once

#include <mrpt/core/Clock.h>

#include <Eigen/Dense>
#include <cstdint>
#include <map>
#include <string>

#include "quadmap/geometry/Ellipsoid.h"

namespace quadmap
{
using ObjectId = std::uint32_t;

/** An upright object's state: (x, y, z [m], yaw [rad], ln a, ln b, ln c), in the map frame. */
using UprightState = Eigen::Matrix<double, 7, 1>;
using UprightCovariance = Eigen::Matrix<double, 7, 7>;

UprightState uprightStateOf(const Ellipsoid& object);
Ellipsoid ellipsoidOf(const UprightState& state);

/** The covariance of two estimates of one object together when nobody knows how their errors are
 * correlated: covariance intersection [Julier, Uhlmann, 1997] with the least determinant. Two equal
 * ones know no more than one. Both are positive definite. */
UprightCovariance covarianceIntersection(const UprightCovariance& a, const UprightCovariance& b);

/** Whether a matrix is symmetric and has no negative eigenvalue, but for rounding. It may know
 * nothing in some direction and everything in another. False for what is not finite.
 * \param rounding Share of its largest element, >= 0. */
bool isPositiveSemidefinite(const UprightCovariance& m, double rounding = 1e-9);

/** The nearest matrix without negative eigenvalues. */
UprightCovariance withoutNegative(const UprightCovariance& symmetric);

/** The most frequent label; ties go to the alphabetically first. Empty when there is none. */
std::string mostFrequentLabel(const std::map<std::string, unsigned>& counts);

/** One landmark of the object map. */
struct MapObject
{
  ObjectId id = 0;
  Ellipsoid object;  //!< In the map frame, z up
  UprightCovariance covariance = UprightCovariance::Identity();
  std::map<std::string, unsigned> labelCounts;   //!< Canonical label -> measurements that said so
  unsigned completeCount = 0, partialCount = 0;  //!< Measurements that were used
  unsigned missCount = 0;                        //!< Frames that should have shown it and did not
  bool orientationDefined = true;
  /** Round in plan, though its label has a direction, as a round table: its measurements tell, so
   * that files do not keep it. */
  bool isRound = false;
  double existenceLogOdds = 0;  //!< From measurements and misses
  /** From its sizes, see sizeEvidence(). The estimate and the label tell, so that files do not keep
   * it. */
  double sizeLogOdds = 0;
  bool confirmed = false;  //!< Enough evidence to be reported
  mrpt::Clock::time_point firstSeen, lastSeen;

  unsigned observations() const { return completeCount + partialCount; }
  std::string label() const { return mostFrequentLabel(labelCounts); }
  double logOdds() const { return existenceLogOdds + sizeLogOdds; }  //!< Of its existence
  double existence() const;                                          //!< Probability, in [0, 1]
};

}  // namespace quadmap
