#include "detector/ViewErrors.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>

namespace quadmap::simulator
{
namespace
{
constexpr double kDistances = 1.35;  // a view ends where the distance has changed by this factor
constexpr double kMostEdge = 0.5;    // no edge errs by more, in sizes of the box

/** Which cell of directions and distances a view is in; cells of different objects have different
 * borders. */
std::uint64_t cellOfView(
    const DetectorOptions& options,
    std::uint64_t seed,
    std::size_t object,
    const Eigen::Vector3d& eye)
{
  RandomStream random(seed, Purpose::View, object);
  const double turn = random.uniform(), near = random.uniform();
  const double azimuth = mrpt::RAD2DEG(std::atan2(eye.y(), eye.x())) + 180;
  const double distance = std::log(std::max(0.1, eye.norm()) / 0.01) / std::log(kDistances);
  const auto a = static_cast<std::uint64_t>(azimuth / options.viewAngle_deg + turn);
  const auto d = static_cast<std::uint64_t>(distance + near);
  return ((static_cast<std::uint64_t>(object) + 1) * 1000 + a) * 1000 + d;
}

/** Student's t with three degrees of freedom: one in a hundred is beyond 4.5 times the scale. */
double longTailed(RandomStream& random)
{
  const double g = random.gaussian();
  double squares = 0;
  for (int i = 0; i < 3; ++i)
  {
    const double x = random.gaussian();
    squares += x * x;
  }
  return g / std::sqrt(std::max(1e-9, squares / 3));
}

/** A box of only a part: mostly what is above, as the back of a chair, or one side. */
Eigen::Vector4d partOf(RandomStream& random)
{
  const double cut = random.uniform(0.25, 0.6), which = random.uniform();
  if (which < 0.5) return {0, 0, 0, cut};
  if (which < 0.65) return {0, cut, 0, 0};
  return which < 0.83 ? Eigen::Vector4d(cut, 0, 0, 0) : Eigen::Vector4d(0, 0, cut, 0);
}

}  // namespace

bool hasViewErrors(const DetectorOptions& o)
{
  return o.viewEdges > 0 || o.viewMisses > 0 || o.viewFlips > 0 || o.viewParts > 0 ||
         o.viewMergers > 0;
}

ViewErrors viewErrors(
    const DetectorOptions& options,
    std::uint64_t seed,
    std::size_t object,
    const Eigen::Vector3d& eye)
{
  RandomStream random(seed, Purpose::View, cellOfView(options, seed, object, eye));
  ViewErrors errors;
  for (int i = 0; i < 4; ++i)
    errors.edges[i] = std::clamp(options.viewEdges * longTailed(random), -kMostEdge, kMostEdge);
  errors.isMissed = random.uniform() < options.viewMisses;
  const bool flips = random.uniform() < options.viewFlips;
  const double which = random.uniform();
  if (flips) errors.wrongLabel = which;
  const Eigen::Vector4d cut = partOf(random);
  if (random.uniform() < options.viewParts) errors.cut = cut;
  errors.isMerged = random.uniform() < options.viewMergers;
  errors.hidesNeighbour = random.uniform() < 0.5;
  return errors;
}

}  // namespace quadmap::simulator
