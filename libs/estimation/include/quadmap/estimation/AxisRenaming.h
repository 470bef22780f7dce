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
};

/** The renaming that brings the heading of `from` nearest to that of `to`. */
AxisRenaming axisRenaming(const UprightState& from, const UprightState& to);

}  // namespace quadmap
