#include "quadmap/dense/DepthCheck.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "FramePoints.h"
#include "IsometryOf.h"
#include "quadmap/dense/ObjectPoints.h"
#include "quadmap/geometry/Projection.h"
#include "quadmap/surfaces/DepthCloud.h"

namespace quadmap
{
namespace
{
/** Distance of a point from the surface of a cuboid, negative inside: equation (22.4) [m]. */
double distanceFrom(const Ellipsoid& cuboid, const Eigen::Vector3d& p_map)
{
  const Eigen::Vector3d beyond =
      (cuboid.rotation().transpose() * (p_map - cuboid.center())).cwiseAbs() - cuboid.semiAxes();
  const double farthest = beyond.maxCoeff();
  return farthest > 0 ? beyond.cwiseMax(0).norm() : farthest;
}

void judgePoints(const ObjectPoints& points, double tolerance, SelfCheckedObject& out)
{
  out.points = points.cloud.size();
  if (points.cloud.empty()) return;
  double inside = 0, beyond = 0;
  for (const DensePoint& point : points.cloud)
  {
    const double distance = distanceFrom(points.record.object, point.position.cast<double>());
    if (distance > tolerance)
      ++beyond;
    else if (distance < -tolerance)
      ++inside;
  }
  const auto count = static_cast<double>(points.cloud.size());
  out.inside = inside / count;
  out.beyond = beyond / count;
  out.onSurface = 1 - *out.inside - *out.beyond;
}

/** An object as the rays of one camera meet it. */
class ObjectInView
{
 public:
  explicit ObjectInView(const Ellipsoid& object_optical) :
      half_(object_optical.semiAxes()),
      R_obj_optical_(object_optical.rotation().transpose()),
      eye_obj_(-(R_obj_optical_ * object_optical.center()))
  {
  }

  struct Depths
  {
    double enter = 0, leave = 0;
  };

  /** Where a ray is in the cuboid, if it goes through the core of the object.
   *  \param ray Of depth 1, optical frame. */
  std::optional<Depths> of(const Eigen::Vector3d& ray) const
  {
    const Eigen::Vector3d d = R_obj_optical_ * ray;
    const Eigen::Vector3d u = d.cwiseQuotient(half_), o = eye_obj_.cwiseQuotient(half_);
    // The smallest |o + z u| over z is the distance of the ray from the centre, in semi-axes.
    const double squared = o.squaredNorm() - std::pow(o.dot(u), 2) / u.squaredNorm();
    if (!(squared < kCore * kCore)) return std::nullopt;
    Depths depths{-1e9, 1e9};
    for (int axis = 0; axis < 3; ++axis)
    {
      if (u[axis] == 0) continue;
      const double a = (-1 - o[axis]) / u[axis], b = (1 - o[axis]) / u[axis];
      depths.enter = std::max(depths.enter, std::min(a, b));
      depths.leave = std::min(depths.leave, std::max(a, b));
    }
    return depths;
  }

  /** Part of the ellipsoid's size that its core has. */
  static constexpr double kCore = 0.5;

 private:
  Eigen::Vector3d half_;
  Eigen::Matrix3d R_obj_optical_;
  Eigen::Vector3d eye_obj_;
};

/** Counts the rays of an image that go through the core of an object or end before it does:
 * equation (22.5). */
class RayCount
{
 public:
  RayCount(const KeyframeScan& image, const DenseOptions& options) :
      options_(options), cloud_(*image.scan, trusted(options))
  {
    T_optical_map_ = -(image.T_map_robot + image.scan->sensorPose + T_sensor_optical());
  }

  void count(const Ellipsoid& object_map, std::size_t& rays, std::size_t& through) const
  {
    const Ellipsoid object = object_map.transformed(T_optical_map_);
    const auto outline = projectEllipsoidBox(
        cloud_.camera(), Ellipsoid(object.pose(), ObjectInView::kCore * object.semiAxes()));
    if (!outline) return;
    const auto range = cloud_.cellsOf(*outline);
    const ObjectInView inView(object);
    for (int r = range.r0; r < range.r1; ++r)
      for (int c = range.c0; c < range.c1; ++c)
      {
        if (!cloud_.valid(c, r) || cloud_.isFlyingPixel(c, r)) continue;
        const Eigen::Vector3d p = cloud_.point(c, r).cast<double>();
        const double tolerance = options_.surfaceTolerance + 3 * noise_.depthSigma(p.z());
        const auto depths = inView.of(p / p.z());
        if (!depths || p.z() < depths->enter - tolerance) continue;  // something is in front
        ++rays;
        through += p.z() > depths->leave + tolerance ? 1 : 0;
      }
  }

 private:
  static SurfaceOptions trusted(const DenseOptions& options)
  {
    SurfaceOptions surface;
    surface.maxRange = options.maxRange;
    surface.maxDepthNoiseFactor = 1;  // the noise is not asked of the cloud
    return surface;
  }

  DenseOptions options_;
  SurfaceOptions noise_;
  DepthCloud cloud_;
  mrpt::poses::CPose3D T_optical_map_;
};

}  // namespace

SelfCheck checkAgainstDepth(
    const std::string& result,
    const std::vector<ObjectRecord>& objects,
    const DenseOptions& options,
    const std::function<void(double)>& progress)
{
  SelfCheck check;
  const auto points =
      findObjectPoints(result, objects, options, [&](double share) { progress(0.5 * share); });
  for (const ObjectPoints& object : points)
  {
    check.objects.emplace_back();
    check.objects.back().id = object.record.id;
    check.objects.back().label = object.record.label;
    judgePoints(object, options.surfaceTolerance, check.objects.back());
  }
  std::vector<std::size_t> through(objects.size(), 0);
  const auto countRays = [&](const KeyframeScan& image)
  {
    const RayCount rays(image, options);
    for (std::size_t i = 0; i < objects.size(); ++i)
      rays.count(objects[i].object, check.objects[i].rays, through[i]);
  };
  forEachDepthImage(
      result, ResultKeyframes::Boxes::Ignore, options, countRays,
      [&](double share) { progress(0.5 + 0.5 * share); });
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (SelfCheckedObject& object = check.objects[i]; object.rays > 0)
      object.through = static_cast<double>(through[i]) / static_cast<double>(object.rays);
  return check;
}

}  // namespace quadmap
