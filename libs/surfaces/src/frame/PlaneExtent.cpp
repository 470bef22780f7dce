#include "quadmap/surfaces/PlaneExtent.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "quadmap/geometry/ConvexHull.h"

namespace quadmap
{
namespace
{
Eigen::Vector2d nearestOnSegment(
    const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  const Eigen::Vector2d d = b - a;
  const double length2 = d.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(d) / length2, 0.0, 1.0) : 0.0;
  return a + t * d;
}

}  // namespace

PlaneExtent::PlaneExtent(const Eigen::Vector3d& normal, const std::vector<Eigen::Vector3d>& points)
{
  along_.row(0) = normal.unitOrthogonal();
  along_.row(1) = normal.cross(Eigen::Vector3d(along_.row(0)));
  std::vector<Eigen::Vector2d> flat;
  for (const auto& p : points) flat.push_back(along_ * p);
  corners_ = convexHull(std::move(flat));
  for (std::size_t i = 0; i < corners_.size(); ++i)
  {
    const Eigen::Vector2d &a = corners_[i], along = corners_[(i + 1) % corners_.size()] - a;
    const Eigen::Vector2d outwards = Eigen::Vector2d(along.y(), -along.x()).normalized();
    sides_.push_back({outwards, outwards.dot(a)});
  }
}

double PlaneExtent::area() const
{
  double twice = 0;
  for (std::size_t i = 0; i < corners_.size(); ++i)
    twice += cross(corners_[i], corners_[(i + 1) % corners_.size()]);
  return 0.5 * twice;
}

PlaneExtent::Rim PlaneExtent::nearestRim(const Eigen::Vector2d& q) const
{
  Rim out;
  out.isInside = corners_.size() > 2;
  double nearest = std::numeric_limits<double>::infinity();  // squared [m^2]
  for (std::size_t i = 0; i < corners_.size(); ++i)
  {
    const Eigen::Vector2d &a = corners_[i], &b = corners_[(i + 1) % corners_.size()];
    const Eigen::Vector2d step = nearestOnSegment(q, a, b) - q;
    if (const double squared = step.squaredNorm(); squared < nearest)
    {
      nearest = squared;
      out.step = step;
    }
    out.isInside = out.isInside && cross(b - a, q - a) >= 0;
  }
  return out;
}

double PlaneExtent::outside(const Eigen::Vector3d& p) const
{
  if (isEverywhere()) return -std::numeric_limits<double>::infinity();
  const Rim rim = nearestRim(along_ * p);
  return rim.isInside ? -rim.step.norm() : rim.step.norm();
}

Eigen::Vector3d PlaneExtent::toExtent(const Eigen::Vector3d& p) const
{
  if (isEverywhere()) return Eigen::Vector3d::Zero();
  const Rim rim = nearestRim(along_ * p);
  return rim.isInside ? Eigen::Vector3d::Zero() : Eigen::Vector3d(along_.transpose() * rim.step);
}

bool PlaneExtent::isWithin(const Eigen::Vector3d& p, double margin) const
{
  if (isEverywhere()) return true;
  const Eigen::Vector2d q = along_ * p;
  double farthest = -std::numeric_limits<double>::infinity();  // outside of any side [m]
  for (const auto& side : sides_) farthest = std::max(farthest, side.outwards.dot(q) - side.offset);
  if (corners_.size() > 2 && farthest <= 0) return true;
  return farthest < margin && outside(p) < margin;
}

}  // namespace quadmap
