#include "edges/Occluders.h"

#include <algorithm>
#include <cmath>

#include "cloud/Precision.h"
#include "quadmap/geometry/RobustStatistics.h"

namespace quadmap
{
Occluders::Occluders(
    const DepthCloud& cloud,
    const ImageBox& box,
    const EdgeContext& context,
    const PerceptionOptions& options) :
    cloud_(cloud), context_(context), options_(options), inside_(cloud.cellsOf(box))
{
  if (!context.object.empty()) lowest_ = lowestHeight();
  for (const auto& screen : context.screens)
    if (!showOneThing(screen.box, box))
      screens_.push_back({cloud.cellsOf(screen.box), screen.depth});
}

double Occluders::shareNearer(const ImageBox& part, double limit) const
{
  const auto range = cloud_.cellsOf(part);
  const int step = context_.object.step;
  int cells = 0, nearer = 0;
  for (int r = range.r0; r < range.r1; r += step)
    for (int c = range.c0; c < range.c1; c += step)
    {
      ++cells;
      nearer += cloud_.valid(c, r) && !context_.object.mask.contains(c, r) && isInFront(c, r, limit)
                    ? 1
                    : 0;
    }
  return cells > 0 ? static_cast<double>(nearer) / cells : 0.0;
}

bool Occluders::isOnSupport(int c, int r) const
{
  const double tolerance = onSupport(cloud_.depth(c, r));
  const Eigen::Vector3d p = cloud_.point(c, r).cast<double>();
  return std::any_of(
      context_.surfaces.begin(), context_.surfaces.end(),
      [&](const Plane& surface) { return std::abs(surface.signedDistance(p)) < tolerance; });
}

bool Occluders::isOnScreen(int c, int r, double limit) const
{
  return std::any_of(
      screens_.begin(), screens_.end(),
      [&](const auto& screen) { return screen.depth < limit && screen.cells.contains(c, r); });
}

/** Of the lowest part that is seen of the object, above the camera [m]; it is not empty. */
double Occluders::lowestHeight() const
{
  const auto& points = context_.object.points;
  std::vector<double> heights;
  for (std::size_t i = 0; i < points.size(); i += sampleStep(points.size()))
    heights.push_back(context_.up.dot(points[i]));
  return quantile(std::move(heights), kStrayShare);
}

/** Does a cell hide only what is lower than the object? Its ray descends from there, so what
 * hides the object's lower end from above rises above the lowest that is seen of it, by as much
 * more as it is nearer. A surface that does not, such as the desk before a screen's foot, leads
 * up to the object, whether or not it was found to be a plane. */
bool Occluders::hidesOnlyBelow(int c, int r) const
{
  const double height = context_.up.dot(cloud_.point(c, r).cast<double>());
  return lowest_ && height < 0 && height < *lowest_ + onSupport(cloud_.depth(c, r));
}

}  // namespace quadmap
