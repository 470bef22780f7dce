#pragma once

#include "quadmap/estimation/MapObject.h"

namespace quadmap
{
/** x -> P x + c: the state of the same object with its axes renamed by a number of quarter turns.
 */
struct AxisRenaming
{
  UprightCovariance P = UprightCovariance::Identity();
  UprightState c = UprightState::Zero();

  UprightState state(const UprightState& x) const { return P * x + c; }
  /** Of a covariance or an information matrix. */
  UprightCovariance matrix(const UprightCovariance& M) const { return P * M * P.transpose(); }
};

/** The renaming by so many quarter turns to the left. */
AxisRenaming axisRenaming(int quarterTurns);

/** The renaming that brings the heading of `from` nearest to that of `to`. */
AxisRenaming axisRenaming(const UprightState& from, const UprightState& to);

}  // namespace quadmap
