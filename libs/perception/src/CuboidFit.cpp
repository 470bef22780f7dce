#include "CuboidFit.h"

#include <algorithm>
#include <cmath>

#include "LevelCloud.h"
#include "quadmap/geometry/RobustStatistics.h"

namespace quadmap
{
namespace
{
constexpr double kMinHalfSize = 0.008;  // [m]; thinner things are not measured by these sensors
constexpr double kTailShare = 0.005;    // of the points beyond a silhouette, cut as flying pixels

/** Where one face of the cuboid is, and why. */
struct FaceEstimate
{
  double position = 0;  // along the outward normal, from the camera [m]
  FaceMeasurement worth;
};

/** Looks at an object's cloud along the axes of its cuboid. */
class FaceEstimator
{
 public:
  FaceEstimator(
      const DepthCloud& cloud,
      const ScenePlanes& planes,
      const ObjectCloud& object,
      const LevelCloud& level,
      double yaw,
      const PerceptionOptions& options) :
      cloud_(cloud), planes_(planes), object_(object), options_(options), range_(level.medianRange)
  {
    cells_ = level.cells;
    R_obj_optical_ = Eigen::AngleAxisd(-yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
                     level.R_level_optical;
    const Eigen::Matrix3d R_obj_level = R_obj_optical_ * level.R_level_optical.transpose();
    for (std::size_t i = 0; i < level.points.size(); ++i)
    {
      points_.push_back(R_obj_level * level.points[i]);
      normals_.push_back(
          level.normals[i] ? Eigen::Vector3d(R_obj_level * *level.normals[i])
                           : Eigen::Vector3d::Zero());
      centroid_ += points_.back();
    }
    centroid_ /= static_cast<double>(points_.size());
    mask_.assign(static_cast<std::size_t>(cloud.columns() * cloud.rows()), false);
    for (const auto& cell : object.cells) mask_[maskIndex(cell.c, cell.r)] = true;
  }

  const Eigen::Matrix3d& R_obj_optical() const { return R_obj_optical_; }
  double range() const { return range_; }

  /** Cosine between a face's outward normal and the line of sight: > 0 faces away. */
  double facingAway(int axis, int sign) const { return sign * centroid_.normalized()[axis]; }

  double lowestSeen() const  //!< Along the object's z, from the camera [m]
  {
    std::vector<double> z;
    for (const auto& p : points_) z.push_back(p.z());
    return quantile(std::move(z), kTailShare);
  }

  /** Of the face whose outward normal is `sign` times axis `axis`. */
  FaceEstimate face(int axis, int sign) const
  {
    std::vector<double> along;
    for (const auto& p : points_) along.push_back(sign * p[axis]);
    const double extreme = quantile(along, 1.0 - kTailShare);
    if (const auto seen = seenFace(axis, sign, along, extreme)) return *seen;
    return silhouette(axis, sign, along, extreme);
  }

 private:
  std::size_t maskIndex(int c, int r) const
  {
    return static_cast<std::size_t>(r * cloud_.columns() + c);
  }

  /** A face that the camera looked at: many points with its normal, just inside the extreme. */
  std::optional<FaceEstimate> seenFace(
      int axis, int sign, const std::vector<double>& along, double extreme) const
  {
    constexpr double kMinCosine = 0.85, kShell = 0.06;  // [m]
    std::vector<double> shell;
    for (std::size_t i = 0; i < along.size(); ++i)
      if (sign * normals_[i][axis] > kMinCosine && along[i] > extreme - kShell)
        shell.push_back(along[i]);
    const double fewest = std::max(20.0, 0.03 * static_cast<double>(along.size()));
    if (static_cast<double>(shell.size()) < fewest) return {};
    const double sigma = std::hypot(0.005, 0.5 * options_.depthSigma(range_));
    return FaceEstimate{
        median(std::move(shell)), {FaceKind::Measured, sigma}
    };
  }

  /** A face that shows by its outline only. */
  FaceEstimate silhouette(
      int axis, int sign, const std::vector<double>& along, double extreme) const
  {
    constexpr double kRim = 0.03, kMaxCut = 0.3, kMinProfile = 0.3;  // [m], shares
    std::vector<std::size_t> rim;
    for (std::size_t i = 0; i < along.size(); ++i)
      if (along[i] > extreme - kRim) rim.push_back(i);
    int cut = 0, profile = 0, withNormal = 0;
    for (const std::size_t i : rim)
    {
      cut += isCut(cells_[i], axis, sign) ? 1 : 0;
      if (normals_[i].isZero()) continue;
      ++withNormal;
      profile += std::abs(normals_[i][axis]) < 0.5 ? 1 : 0;
    }
    const double footprint = cloud_.stride() * range_ / std::abs(cloud_.camera().fx);
    FaceEstimate out{
        extreme, {FaceKind::Measured, 0.012 + footprint}
    };
    const bool isCutOff = cut > kMaxCut * static_cast<double>(rim.size());
    // A side that faces away counts when a surface that leads up to it is seen, as the top of a
    // cabinet does for its back; a rim that only fades away says "at least this large".
    const double away = facingAway(axis, sign);
    const double depthAlong = extreme - quantile(along, kTailShare);
    const bool leadsUp = withNormal > 0 && profile > kMinProfile * withNormal && depthAlong > 0.05;
    if (isCutOff || (away > 0.25 && !leadsUp)) out.worth.kind = FaceKind::AtLeast;
    if (away > 0.25) out.worth.sigma += 0.01 + 0.03 * depthAlong;
    return out;
  }

  /** Does the object go on beyond a cell at its rim: at the image border, behind something nearer,
   * or on a surface that the box or the cluster cut off? */
  bool isCut(const ObjectCloud::Cell& cell, int axis, int sign) const
  {
    const Eigen::Vector3d p = cloud_.point(cell.c, cell.r).cast<double>();
    const Eigen::Vector3d ahead = p + 0.05 * sign * R_obj_optical_.row(axis).transpose();
    if (ahead.z() < 0.05) return true;
    const auto& camera = cloud_.camera();
    const Eigen::Vector2d step = camera.project(ahead) - camera.project(p);
    if (step.norm() < 1e-6) return false;
    const Eigen::Vector2d direction = step.normalized();
    constexpr int kReach = 10;  // cells
    constexpr int kBorder = 3;  // cells; the sensor's own rim is empty
    for (int i = 1; i <= kReach; ++i)
    {
      const int c = static_cast<int>(std::lround(cell.c + i * direction.x()));
      const int r = static_cast<int>(std::lround(cell.r + i * direction.y()));
      if (c < kBorder || r < kBorder || c >= cloud_.columns() - kBorder ||
          r >= cloud_.rows() - kBorder)
        return true;
      if (mask_[maskIndex(c, r)] || !cloud_.valid(c, r) || cloud_.isFlyingPixel(c, r)) continue;
      const Eigen::Vector3d q = cloud_.point(c, r).cast<double>();
      const double tolerance = 0.03 + 3.0 * options_.depthSigma(p.z());
      if (object_.support &&
          std::abs(planes_.plane(*object_.support).plane.signedDistance(q)) < tolerance)
        return false;
      return q.z() < p.z() + tolerance;
    }
    return false;
  }

  const DepthCloud& cloud_;
  const ScenePlanes& planes_;
  const ObjectCloud& object_;
  const PerceptionOptions& options_;
  double range_;
  Eigen::Matrix3d R_obj_optical_;
  Eigen::Vector3d centroid_ = Eigen::Vector3d::Zero();
  std::vector<ObjectCloud::Cell> cells_;
  std::vector<Eigen::Vector3d> points_, normals_;
  std::vector<bool> mask_;
};

/** Faces in the order +x, -x, +y, -y, +z, -z. */
using Faces = std::array<FaceEstimate, kFaces>;

/** Distance of the supporting plane below the camera, along the object's -z. */
FaceEstimate supportFace(const Plane& support, double range, const PerceptionOptions& options)
{
  return {
      support.d, {FaceKind::Support, std::hypot(0.006, 0.5 * options.depthSigma(range))}
  };
}

/** Round things (cups, balls): the near side and the width are seen, the depth equals the width. */
void completeRound(Faces& faces)
{
  const double radius = 0.5 * (faces[2].position + faces[3].position);
  FaceEstimate& far = faces[0];
  const double near = -faces[1].position;
  if (faces[2].worth.kind != FaceKind::Measured || faces[3].worth.kind != FaceKind::Measured)
    return;
  if (near + 2.0 * radius < far.position) return;  // deeper than wide: keep what was seen
  far.position = near + 2.0 * radius;
  far.worth = {FaceKind::Measured, 0.01 + 0.2 * radius};
}

/** When the lower part is hidden (a chair behind a table), what is seen bounds the whole only from
 * inside: the object may come nearer below. */
void doubtHiddenPart(Faces& faces, double lowestSeen, const FaceEstimator& estimator)
{
  constexpr double kMaxHidden = 0.3;   // of the height
  constexpr double kSideDoubt = 0.03;  // [m]
  const double bottom = -faces[5].position, top = faces[4].position;
  if (lowestSeen - bottom < kMaxHidden * (top - bottom)) return;
  for (int axis = 0; axis < 2; ++axis)
    for (int side = 0; side < 2; ++side)
    {
      auto& worth = faces[static_cast<std::size_t>(2 * axis + side)].worth;
      if (estimator.facingAway(axis, side == 0 ? 1 : -1) < -0.25) worth.kind = FaceKind::AtLeast;
      worth.sigma += kSideDoubt;
    }
}

CompleteMeasurement assemble(const Faces& faces, const Eigen::Matrix3d& R_obj_optical)
{
  CompleteMeasurement out;
  Eigen::Vector3d center_obj, semiAxes;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto positive = static_cast<std::size_t>(2 * axis), negative = positive + 1;
    const double high = faces[positive].position, low = -faces[negative].position;
    center_obj[axis] = 0.5 * (high + low);
    semiAxes[axis] = std::max(kMinHalfSize, 0.5 * (high - low));
    out.faces[positive] = faces[positive].worth;
    out.faces[negative] = faces[negative].worth;
  }
  mrpt::math::CMatrixDouble33 R;
  const Eigen::Matrix3d R_optical_obj = R_obj_optical.transpose();
  const Eigen::Vector3d center = R_optical_obj * center_obj;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) R(i, j) = R_optical_obj(i, j);
  const mrpt::poses::CPose3D T_optical_obj(
      R, mrpt::math::TPoint3D(center.x(), center.y(), center.z()));
  out.object_sensor = Ellipsoid(T_optical_obj, semiAxes);
  return out;
}

}  // namespace

CompleteMeasurement fitCuboid(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ObjectCloud& object,
    const LabelProperties& label,
    const PerceptionOptions& options)
{
  const Eigen::Vector3d up = object.support ? planes.plane(*object.support).plane.n : planes.up;
  const LevelCloud level = levelCloud(cloud, object, up);
  const YawEstimate yaw = label.dominantDirection ? estimateYaw(level, options) : YawEstimate();

  const FaceEstimator estimator(cloud, planes, object, level, yaw.yaw, options);
  Faces faces;
  for (int axis = 0; axis < 3; ++axis)
  {
    faces[static_cast<std::size_t>(2 * axis)] = estimator.face(axis, 1);
    faces[static_cast<std::size_t>(2 * axis + 1)] = estimator.face(axis, -1);
  }
  if (object.support)
  {
    faces[5] = supportFace(planes.plane(*object.support).plane, estimator.range(), options);
    doubtHiddenPart(faces, estimator.lowestSeen(), estimator);
  }
  if (!label.dominantDirection) completeRound(faces);

  CompleteMeasurement out = assemble(faces, estimator.R_obj_optical());
  out.yawDefined = yaw.defined;
  out.yawSigma = yaw.sigma;
  out.yawDominance = yaw.dominance;
  return out;
}

}  // namespace quadmap
