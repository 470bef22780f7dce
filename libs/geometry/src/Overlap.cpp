#include "quadmap/geometry/Overlap.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

namespace quadmap
{
namespace
{
/** A solid bounded by a closed surface of triangles, counter-clockwise seen from outside.
 *
 * Clipping classifies each vertex once and cuts each edge once. The surface therefore stays closed
 * whatever rounding does: a vertex or face on the clipping plane makes a triangle without area but
 * never a hole. The volume is as accurate as the coordinates. */
class TriangleSolid
{
 public:
  /** The cuboid [-s, s]. */
  explicit TriangleSolid(const Eigen::Vector3d& s)
  {
    for (int i = 0; i < 8; ++i)
      vertices_.emplace_back(
          (i & 1) ? s.x() : -s.x(), (i & 2) ? s.y() : -s.y(), (i & 4) ? s.z() : -s.z());
    constexpr std::array<std::array<std::size_t, 4>, 6> sides{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}
    };
    for (const auto& f : sides)
    {
      triangles_.push_back({f[0], f[1], f[2]});
      triangles_.push_back({f[0], f[2], f[3]});
    }
  }

  /** Keeps the part where n.p <= offset. */
  void clip(const Eigen::Vector3d& n, double offset)
  {
    std::vector<double> height;
    height.reserve(vertices_.size());
    for (const auto& p : vertices_) height.push_back(n.dot(p) - offset);

    std::vector<Triangle> kept;
    std::vector<std::pair<std::size_t, std::size_t>>
        rim;  // edges of the cut, as the kept side has them
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> cuts;
    for (const Triangle& t : triangles_) clipTriangle(t, height, cuts, kept, rim);
    for (const auto& [from, to] : rim) kept.push_back({rim.front().first, to, from});
    triangles_ = std::move(kept);
  }

  double volume() const
  {
    if (triangles_.empty()) return 0;
    const Eigen::Vector3d origin = vertices_[triangles_.front()[0]];
    double sum = 0;
    for (const auto& [a, b, c] : triangles_)
      sum += (vertices_[a] - origin).dot((vertices_[b] - origin).cross(vertices_[c] - origin));
    return std::max(0.0, sum / 6.0);
  }

 private:
  using Triangle = std::array<std::size_t, 3>;
  using Cuts = std::map<std::pair<std::size_t, std::size_t>, std::size_t>;

  void clipTriangle(
      const Triangle& t,
      const std::vector<double>& height,
      Cuts& cuts,
      std::vector<Triangle>& kept,
      std::vector<std::pair<std::size_t, std::size_t>>& rim)
  {
    const auto inside = [&](std::size_t i) { return height[t[i % 3]] <= 0; };
    const int count = int(inside(0)) + int(inside(1)) + int(inside(2));
    if (count == 0) return;
    if (count == 3)
    {
      kept.push_back(t);
      return;
    }
    // `a` is the corner that is alone on its side of the plane; ab and ac cut its two edges.
    std::size_t alone = 0;
    while (inside(alone) != (count == 1)) ++alone;
    const std::size_t a = t[alone], b = t[(alone + 1) % 3], c = t[(alone + 2) % 3];
    const std::size_t ab = cutEdge(a, b, height, cuts), ac = cutEdge(a, c, height, cuts);
    if (count == 1)
    {
      kept.push_back({a, ab, ac});
      rim.emplace_back(ab, ac);
    }
    else
    {
      kept.push_back({ab, b, c});
      kept.push_back({ab, c, ac});
      rim.emplace_back(ac, ab);
    }
  }

  std::size_t cutEdge(std::size_t a, std::size_t b, const std::vector<double>& height, Cuts& cuts)
  {
    if (a > b) std::swap(a, b);
    const auto [cut, isNew] = cuts.emplace(std::make_pair(a, b), vertices_.size());
    if (isNew)
    {
      const double share = height[a] / (height[a] - height[b]);
      const Eigen::Vector3d p = vertices_[a] + share * (vertices_[b] - vertices_[a]);
      vertices_.push_back(p);
    }
    return cut->second;
  }

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Triangle> triangles_;
};
}  // namespace

double cuboidIntersectionVolume(const Ellipsoid& a, const Ellipsoid& b)
{
  // In the frame of a the numbers are small, and a is the cuboid [-s, s].
  const Eigen::Matrix3d R_a_b = a.rotation().transpose() * b.rotation();
  const Eigen::Vector3d t_a_b = a.rotation().transpose() * (b.center() - a.center());
  if (t_a_b.norm() >= a.semiAxes().norm() + b.semiAxes().norm()) return 0;

  TriangleSolid solid(a.semiAxes());
  for (int i = 0; i < 3; ++i)
  {
    const Eigen::Vector3d n = R_a_b.col(i);
    solid.clip(n, n.dot(t_a_b) + b.semiAxes()[i]);
    solid.clip(-n, -n.dot(t_a_b) + b.semiAxes()[i]);
  }
  return std::min({solid.volume(), a.cuboidVolume(), b.cuboidVolume()});
}

double cuboidIoU(const Ellipsoid& a, const Ellipsoid& b)
{
  const double common = cuboidIntersectionVolume(a, b);
  return common / (a.cuboidVolume() + b.cuboidVolume() - common);
}

double alignedIoU(const Eigen::Vector3d& sizesA, const Eigen::Vector3d& sizesB)
{
  const double common = sizesA.cwiseMin(sizesB).prod();
  return common / (sizesA.prod() + sizesB.prod() - common);
}

}  // namespace quadmap
