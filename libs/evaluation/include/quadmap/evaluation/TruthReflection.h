#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "quadmap/evaluation/TrajectoryAlignment.h"
#include "quadmap/geometry/Ellipsoid.h"

namespace quadmap
{
/** Makes a left-handed true world, as that of ICL-NUIM, right-handed: y is negated in the world and
 * an axis of the bodies with it. */
class TruthReflection
{
 public:
  /** \param body The diagonal of the matrix that reflects the bodies of the true trajectory. */
  explicit TruthReflection(const Eigen::Vector3d& body) : body_(body) {}

  mrpt::poses::CPose3D operator()(const mrpt::poses::CPose3D& T_truth_body) const;
  Ellipsoid operator()(const Ellipsoid& object) const;

 private:
  Eigen::Vector3d body_;
};

/** Whether the world of a true trajectory is left-handed, by the turns of its bodies and by its
 * positions: doc/mathematics.md, (20.9). Turns about one axis alone do not tell; the world then
 * counts as right-handed. \param pairs In the order of time. */
std::optional<TruthReflection> reflectionOfTruth(const std::vector<PosePair>& pairs);

}  // namespace quadmap
