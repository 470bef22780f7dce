#include "BackgroundPlanes.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace quadmap
{
namespace
{
constexpr double kOutside = 0.5;  // points in a smaller share of the boxes are not the object's

/** Weights of points along an axis, in bins. */
class Profile
{
 public:
  explicit Profile(double bin) : bin_(bin) {}

  void add(double x, double weight) { entries_.push_back({x, weight}); }

  struct Peak
  {
    double center = 0, spread = 0;  // of what lies within the window around it
    double weight = 0;
  };

  /** The local maxima of the weight within +-window, by place. */
  std::vector<Peak> peaks(double window)
  {
    std::vector<Peak> found;
    if (entries_.empty()) return found;
    std::sort(entries_.begin(), entries_.end());
    const double first = entries_.front().first - window;
    const auto bins = static_cast<std::size_t>((entries_.back().first + window - first) / bin_) + 1;
    std::vector<double> sums(bins, 0);
    const int reach = static_cast<int>(std::lround(window / bin_));
    for (const auto& [x, weight] : entries_)
    {
      const int at = static_cast<int>((x - first) / bin_);
      for (int i = std::max(0, at - reach); i <= std::min<int>(at + reach, int(bins) - 1); ++i)
        sums[static_cast<std::size_t>(i)] += weight;
    }
    for (std::size_t i = 0; i < bins; ++i)
      if (isPeak(sums, i, static_cast<std::size_t>(2 * reach)))
        found.push_back(around(first + (static_cast<double>(i) + 0.5) * bin_, window));
    return found;
  }

 private:
  static bool isPeak(const std::vector<double>& sums, std::size_t i, std::size_t reach)
  {
    if (!(sums[i] > 0)) return false;
    const std::size_t from = i > reach ? i - reach : 0, to = std::min(sums.size(), i + reach + 1);
    for (std::size_t j = from; j < to; ++j)
      if (sums[j] > sums[i] || (sums[j] == sums[i] && j < i)) return false;
    return true;
  }

  /** Mean and standard deviation of the entries near a place. */
  Peak around(double x, double window) const
  {
    Peak peak;
    double sum = 0, squares = 0;
    for (const auto& [at, weight] : entries_)
    {
      if (std::abs(at - x) > window) continue;
      peak.weight += weight;
      sum += weight * (at - x);
      squares += weight * (at - x) * (at - x);
    }
    const double mean = sum / peak.weight;
    peak.center = x + mean;
    peak.spread = std::sqrt(std::max(0.0, squares / peak.weight - mean * mean));
    return peak;
  }

  double bin_;
  std::vector<std::pair<double, double>> entries_;
};

/** Squares of the floor plan near the candidates. */
class Surroundings
{
 public:
  explicit Surroundings(const std::vector<NearPoint>& candidates)
  {
    constexpr int kReach = 5;
    for (const NearPoint& point : candidates)
    {
      const auto [x, y] = squareOf(point.position);
      if (!squares_.insert({x, y}).second) continue;
      for (int i = -kReach; i <= kReach; ++i)
        for (int j = -kReach; j <= kReach; ++j) around_.insert({x + i, y + j});
    }
  }

  bool contains(const Eigen::Vector3d& p) const { return around_.count(squareOf(p)) > 0; }

 private:
  static std::pair<int, int> squareOf(const Eigen::Vector3d& p)
  {
    constexpr double kSize = 0.02;  // [m]
    return {int(std::floor(p.x() / kSize)), int(std::floor(p.y() / kSize))};
  }

  std::set<std::pair<int, int>> squares_, around_;
};

/** The upright plane through the points near a guessed one, by least squares. */
BackgroundPlane fittedWall(
    const std::vector<const NearPoint*>& points, const Eigen::Vector3d& normal, double distance)
{
  constexpr double kNear = 0.03;  // [m]
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  double count = 0;
  for (const NearPoint* point : points)
  {
    if (point->normal.dot(normal) < 0.9) continue;
    if (std::abs(normal.dot(point->position) - distance) > kNear) continue;
    const Eigen::Vector2d p = point->position.head<2>();
    sum += p;
    squares += p * p.transpose();
    ++count;
  }
  if (count < 3) return {normal, distance, 0};
  const Eigen::Vector2d mean = sum / count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(
      squares / count - mean * mean.transpose());
  Eigen::Vector3d n(axes.eigenvectors()(0, 0), axes.eigenvectors()(1, 0), 0);
  if (n.dot(normal) < 0) n = -n;
  return {n, n.head<2>().dot(mean), std::sqrt(std::max(0.0, axes.eigenvalues()[0]))};
}

/** Height below which this share of the points lies. */
double heightQuantile(const std::vector<NearPoint>& points, double share)
{
  std::vector<double> heights;
  for (const NearPoint& point : points) heights.push_back(point.position.z());
  const auto at = heights.begin() +
                  static_cast<std::ptrdiff_t>(share * static_cast<double>(heights.size() - 1));
  std::nth_element(heights.begin(), at, heights.end());
  return *at;
}

}  // namespace

std::optional<BackgroundPlane> supportOf(
    const std::vector<NearPoint>& near, const std::vector<NearPoint>& candidates)
{
  constexpr double kFlat = 0.85;      // of the normal's z
  constexpr double kBelow = 0.015;    // a support may be so much above the lowest candidates [m]
  constexpr double kLargePart = 0.5;  // of the largest one, to be a surface of its own
  if (candidates.empty()) return std::nullopt;
  const Surroundings around(candidates);
  const double highest = heightQuantile(candidates, 0.02) + kBelow;
  Profile heights(0.002);
  for (const NearPoint& point : near)
    if (point.share < kOutside && point.normal.z() > kFlat && point.position.z() < highest + 0.05 &&
        around.contains(point.position))
      heights.add(point.position.z(), 1);
  auto peaks = heights.peaks(0.01);
  peaks.erase(
      std::remove_if(
          peaks.begin(), peaks.end(), [&](const auto& peak) { return peak.center > highest; }),
      peaks.end());
  double largest = 0;
  for (const auto& peak : peaks) largest = std::max(largest, peak.weight);
  for (auto peak = peaks.rbegin(); peak != peaks.rend(); ++peak)
    if (peak->weight >= kLargePart * largest)
      return BackgroundPlane{Eigen::Vector3d::UnitZ(), peak->center, peak->spread};
  return std::nullopt;
}

std::vector<BackgroundPlane> wallsOf(
    const std::vector<NearPoint>& near, const std::vector<NearPoint>& candidates)
{
  constexpr double kUpright = 0.3;       // most of the normal's z
  constexpr double kSameHeading = 0.1;   // of normals [rad]
  constexpr std::size_t kFewest = 1500;  // points of a wall: 4 x 10 dm^2 of 5 mm cells
  constexpr double kBehind = 0.02;       // candidates may lie so far behind it [m]
  constexpr double kInFront = 0.97;      // share of the candidates
  constexpr double kSeam = 0.5;          // [rad]
  Profile headings(0.02);
  std::vector<const NearPoint*> upright;
  for (const NearPoint& point : near)
    if (point.share < kOutside && std::abs(point.normal.z()) < kUpright)
    {
      upright.push_back(&point);
      const double heading = std::atan2(point.normal.y(), point.normal.x());
      headings.add(heading, 1);
      if (heading < kSeam - M_PI) headings.add(heading + 2 * M_PI, 1);  // whole around +-pi, too
    }
  std::vector<BackgroundPlane> walls;
  for (const auto& heading : headings.peaks(kSameHeading))
  {
    if (heading.weight < kFewest) continue;
    const Eigen::Vector3d n(std::cos(heading.center), std::sin(heading.center), 0);
    Profile distances(0.005);
    for (const NearPoint* point : upright)
      if (point->normal.dot(n) > std::cos(2 * kSameHeading))
        distances.add(n.dot(point->position), 1);
    for (const auto& peak : distances.peaks(0.02))
    {
      const BackgroundPlane plane = fittedWall(upright, n, peak.center);
      const auto inFront = std::count_if(
          candidates.begin(), candidates.end(),
          [&](const NearPoint& point) { return plane.height(point.position) > -kBehind; });
      if (peak.weight >= kFewest &&
          static_cast<double>(inFront) >= kInFront * static_cast<double>(candidates.size()))
        walls.push_back(plane);
    }
  }
  return walls;
}

}  // namespace quadmap
