#include "edges/Occluders.h"

#include <algorithm>
#include <limits>

#include "quadmap/surfaces/SurfaceTolerance.h"

namespace quadmap
{
Occluders::Occluders(
    const DepthCloud& cloud,
    const ImageBox& box,
    const EdgeContext& context,
    const PerceptionOptions& options) :
    cloud_(cloud),
    context_(context),
    options_(options),
    inside_(cloud.cellsOf(box)),
    lowest_(context.object.empty() ? -std::numeric_limits<double>::infinity() : 0.0)
{
  for (const auto& p : context.object.points) lowest_ = std::min(lowest_, context.up.dot(p));
  for (const auto& screen : context.screens)
    screens_.push_back({cloud.cellsOf(screen.box), screen.depth});
}

bool Occluders::isOnScreen(int c, int r, double limit) const
{
  return std::any_of(
      screens_.begin(), screens_.end(),
      [&](const auto& screen) { return screen.depth < limit && screen.cells.contains(c, r); });
}

/** Does a cell hide only what is lower than the object? Its ray descends from there, so what hides
 * the object's lower end from above rises above the lowest that is seen of it, by as much more as
 * it is nearer. A surface that does not, such as the desk before a screen's foot, leads up to the
 * object, whether or not it was found to be a plane. */
bool Occluders::hidesOnlyBelow(int c, int r) const
{
  const Eigen::Vector3d p = cloud_.point(c, r).cast<double>();
  const double height = context_.up.dot(p);
  return height < 0 && height < lowest_ + unevenSupportTolerance(2.0 * options_.depthSigma(p.z()));
}

}  // namespace quadmap
