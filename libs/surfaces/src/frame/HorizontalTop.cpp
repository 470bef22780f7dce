#include "quadmap/surfaces/HorizontalTop.h"

#include <algorithm>
#include <cmath>

#include "frame/HorizontalFit.h"
#include "quadmap/geometry/DensestWindow.h"
#include "quadmap/geometry/RobustStatistics.h"
#include "quadmap/surfaces/SurfaceTolerance.h"

namespace quadmap
{
namespace
{
constexpr double kBin = 0.01;   // [m]
constexpr int kHalfWindow = 2;  // bins to either side that noise spreads a surface over
constexpr int kApart = 2 * kHalfWindow + 1;  // bins from one window to the next
constexpr double kMinContrast = 2.0;         // to the windows above and below
constexpr double kMinSlope = 0.15;           // of the view down; a flatter one shows the rim alone

/** The area that points cover if they lie on horizontal surfaces, by height above the support. It
 * is known in the window before the first and in that after the last bin of a range, too. */
class AreaOfHeight
{
 public:
  AreaOfHeight(double low, double high) :
      first_(kApart + kHalfWindow),
      end_(first_ + static_cast<int>(std::ceil((high - low) / kBin))),
      low_(low - first_ * kBin),
      bins_(static_cast<std::size_t>(end_ + first_), 0.0)
  {
  }

  void add(double height, double area)
  {
    const double bin = std::floor((height - low_) / kBin);
    if (bin >= 0 && bin < static_cast<double>(bins_.size()))
      bins_[static_cast<std::size_t>(bin)] += area;
  }

  /** Of the window around a bin [m^2]. */
  double window(int bin) const
  {
    double sum = 0;
    for (int i = bin - kHalfWindow; i <= bin + kHalfWindow; ++i)
      sum += bins_[static_cast<std::size_t>(i)];
    return sum;
  }
  int first() const { return first_; }  // bin of the range
  int end() const { return end_; }
  double height(int bin) const { return low_ + (bin + 0.5) * kBin; }

 private:
  int first_, end_;
  double low_;
  std::vector<double> bins_;
};

/** Where a level top may be, above the plane that its height is measured from [m]. */
struct TopHeights
{
  double low, high;
};

/** Above the support the top is as high as such things are. */
TopHeights heightsAboveSupport(const LabelProperties& label)
{
  const double spread = std::exp(kUsualSpreads * label.sizeSpread);
  return {label.typicalSize.z() / spread, label.typicalSize.z() * spread};
}

/** Where no support is known, the top may have any height below the camera. But a level surface
 * that most points are above is what the thing stands on. \param seen Heights of all points,
 * from the camera's; not empty. */
TopHeights heightsBelowCamera(const std::vector<double>& seen, const SurfaceOptions& options)
{
  constexpr double kOnSurface = (kHalfWindow + 0.5) * kBin;
  const double high = *std::max_element(seen.begin(), seen.end());
  return {std::max(median(seen) - kOnSurface, -options.maxRange), std::min(high, 0.0)};
}

/** Adds what each point covers if it lies on a horizontal surface, equation (7.1).
 * \param heights Of the points, and of the camera [m]. */
void addAreas(
    const DepthCloud& cloud,
    const std::vector<Eigen::Vector3d>& points,
    const std::vector<double>& heights,
    int step,
    double cameraHeight,
    AreaOfHeight& areas)
{
  constexpr double kMinBelow = 0.05;  // below the camera; others are seen from beneath [m]
  const double across = step * cloud.stride();
  const double cell = across * across / std::abs(cloud.camera().fx * cloud.camera().fy);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double below = cameraHeight - heights[i], z = points[i].z();
    if (below > kMinBelow) areas.add(heights[i], cell * z * z * z / below);
  }
}

/** The bin of the height with the largest area. It must stand out from the heights beside it, as a
 * vertical side covers all heights alike. */
std::optional<int> largestHeight(const AreaOfHeight& areas)
{
  std::optional<int> best;
  double largest = 0;
  for (int i = areas.first(); i < areas.end(); ++i)
  {
    const double area = areas.window(i);
    const double beside = 0.5 * (areas.window(i - kApart) + areas.window(i + kApart));
    if (area <= largest || area < kMinContrast * beside) continue;
    largest = area;
    best = i;
  }
  return best;
}

/** The level plane that most of the points lie on, with the slope that they tell: what heights are
 * measured along, up or the normal of a support, errs by an angle that tilts a broad surface by
 * more than its noise. \param below The points, below the camera [m]. \param up What heights are
 * measured along. \return Nothing when the camera sees it at too flat an angle. */
std::optional<Plane> planeAmong(
    const std::vector<Eigen::Vector3d>& points,
    double below,
    const Eigen::Vector3d& up,
    const SurfaceOptions& options)
{
  constexpr double kUneven = 0.002;      // [m]
  constexpr double kSteepestTop = 0.05;  // no level top slopes more, and no pose errs more [rad]
  std::vector<double> depths, along;
  for (const auto& p : points) depths.push_back(p.z());
  const double depth = median(std::move(depths));
  const double slope = below / depth;  // (7.2)
  if (slope < kMinSlope) return {};
  const auto fitted = fitMainHeight(points, up, up, options);
  const bool isLevel = fitted && fitted->plane.n.dot(up) > std::cos(kSteepestTop);
  const Eigen::Vector3d n = isLevel ? fitted->plane.n : up;
  for (const auto& p : points) along.push_back(n.dot(p));
  // The rim of a table is near its top, and would move the median of all heights.
  std::sort(along.begin(), along.end());
  const double width = 2 * kUneven + 4 * slope * options.depthSigma(depth);
  return Plane{n, -along[densestWindow(along, width).middle()]};
}

}  // namespace

std::optional<Plane> horizontalTop(
    const DepthCloud& cloud,
    const std::vector<Eigen::Vector3d>& points,
    int step,
    const Plane* support,
    const Eigen::Vector3d& up,
    const LabelProperties& label,
    const SurfaceOptions& options)
{
  if (points.empty()) return {};
  const Plane from = support ? *support : Plane{up, 0};  // else from the camera's own height
  std::vector<double> heights;
  for (const auto& p : points) heights.push_back(from.signedDistance(p));
  const TopHeights range =
      support ? heightsAboveSupport(label) : heightsBelowCamera(heights, options);
  if (range.low >= range.high) return {};
  const double cameraHeight = from.signedDistance(Eigen::Vector3d::Zero());
  AreaOfHeight areas(range.low, range.high);
  addAreas(cloud, points, heights, step, cameraHeight, areas);
  const auto top = largestHeight(areas);
  if (!top) return {};
  std::vector<Eigen::Vector3d> near;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::abs(heights[i] - areas.height(*top)) < (kHalfWindow + 0.5) * kBin)
      near.push_back(points[i]);
  return planeAmong(near, cameraHeight - areas.height(*top), from.n, options);
}

std::optional<PlaneExtent> topExtent(
    const Plane& top, std::vector<Eigen::Vector3d> points, const SurfaceOptions& options)
{
  points.erase(
      std::remove_if(
          points.begin(), points.end(), [&](const auto& p) { return !isOnPlane(p, top, options); }),
      points.end());
  if (points.empty()) return {};
  return PlaneExtent(top.n, points);
}

}  // namespace quadmap
