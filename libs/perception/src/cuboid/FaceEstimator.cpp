#include "cuboid/FaceEstimator.h"

#include <algorithm>
#include <cmath>

#include "cloud/Precision.h"
#include "cuboid/FaceSigmas.h"
#include "quadmap/geometry/LineFit.h"
#include "quadmap/geometry/RobustStatistics.h"
#include "quadmap/surfaces/SurfaceTolerance.h"

namespace quadmap
{
namespace
{
constexpr double kTailShare = 0.005;  // of the points, cut as stray ones

}  // namespace

FaceEstimator::FaceEstimator(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ObjectCloud& object,
    const UprightCloud& upright,
    double yaw,
    const PerceptionOptions& options) :
    cloud_(cloud),
    planes_(planes),
    object_(object),
    options_(options),
    measured_(measuredPart(cloud)),
    range_(upright.medianRange),
    cells_(upright.cells)
{
  R_obj_optical_ = Eigen::AngleAxisd(-yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
                   upright.R_upright_optical;
  const Eigen::Matrix3d R_obj_upright = R_obj_optical_ * upright.R_upright_optical.transpose();
  for (const std::size_t axis : {0, 1, 2})
  {
    points_[axis].resize(size());
    normals_[axis].resize(size());
  }
  for (std::size_t i = 0; i < size(); ++i)
  {
    const Eigen::Vector3d p = R_obj_upright * upright.points[i];
    Eigen::Vector3d n = Eigen::Vector3d::Zero();
    if (upright.normals[i]) n = R_obj_upright * *upright.normals[i];
    for (const std::size_t axis : {0, 1, 2})
    {
      points_[axis][i] = p[static_cast<Eigen::Index>(axis)];
      normals_[axis][i] = n[static_cast<Eigen::Index>(axis)];
    }
    centroid_ += p;
  }
  centroid_ /= static_cast<double>(size());
  for (const std::size_t axis : {0, 1, 2})
  {
    const QuantileRange range = quantileRange(points_[axis], kTailShare);
    extremes_[2 * axis] = range.high;
    extremes_[2 * axis + 1] = -range.low;
  }
}

Eigen::Vector3d FaceEstimator::normalOf(std::size_t face) const
{
  return (face % 2 == 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(static_cast<Eigen::Index>(face / 2));
}

double FaceEstimator::facingAway(std::size_t face) const
{
  return normalOf(face).dot(centroid_.normalized());
}

double FaceEstimator::behind(std::size_t face, const Plane& plane) const
{
  const Eigen::Vector3d n = R_obj_optical_ * plane.n;
  const double ahead = n.dot(centroid_) + plane.d;
  return normalOf(face).dot(centroid_) - ahead / n.dot(normalOf(face));
}

double FaceEstimator::lowestSeen() const { return -extreme(kBottom); }

bool FaceEstimator::isFootInSight() const
{
  const Eigen::Vector3d middle = R_obj_optical_.transpose() * centroid_;
  const Eigen::Vector3d lower = middle + stepTowards(kBottom);
  const Eigen::Vector2d down = cloud_.camera().project(lower) - cloud_.camera().project(middle);
  std::vector<double> visible;
  for (const auto& cell : cells_) visible.push_back(down.dot(Eigen::Vector2d(cell.c, cell.r)));
  const double lowest = quantile(std::move(visible), 1.0 - kStrayShare);
  const double tolerance = kBeyondChance * options_.depthSigma(range_);
  int below = 0, hidden = 0;
  for (int r = object_.inBox.r0; r < object_.inBox.r1; ++r)
    for (int c = object_.inBox.c0; c < object_.inBox.c1; ++c)
    {
      if (down.dot(Eigen::Vector2d(c, r)) <= lowest) continue;
      ++below;
      if (!cloud_.valid(c, r) || cloud_.depth(c, r) > range_ - tolerance) continue;
      const Eigen::Vector3d p = cloud_.point(c, r).cast<double>();
      hidden += isOnSupport(p, tolerance) ? 0 : 1;
    }
  return hidden < kOpenShare * below;
}

bool FaceEstimator::isOnSupport(const Eigen::Vector3d& p, double tolerance) const
{
  return object_.support && std::abs(planes_.plane(*object_.support).plane.signedDistance(p)) <
                                unevenSupportTolerance(tolerance);
}

FaceEstimate FaceEstimator::face(std::size_t face) const
{
  constexpr double kMaxCutTop = 0.15;  // of the lines up through the object
  auto out = surface(face);
  if (!out || face == kTop)
  {
    const Outline lines = outlineTowards(face);
    if (!out) out = outline(face, lines);
    // The upper part of a thing need not be as wide as the lower one (a chair's back): when some of
    // it goes on beyond what is seen, its height is open.
    if (face == kTop && cutShare(lines, face, -1e9) > kMaxCutTop)
      out->worth.kind = FaceKind::AtLeast;
  }
  if (endsOutsideBox(face)) out->worth.kind = FaceKind::Unknown;
  return *out;
}

/** Does the cloud end outside the detector's box on this side? Only a cloud that goes on outside
 * the box can. The end is then that of another thing, which touches the object. */
bool FaceEstimator::endsOutsideBox(std::size_t face) const
{
  constexpr double kEnd = 0.02;  // [m]
  if (object_.leak == 0) return false;
  int end = 0, outside = 0;
  for (std::size_t i = 0; i < size(); ++i)
  {
    if (along(face, i) < extreme(face) - kEnd) continue;
    ++end;
    outside += object_.inBox.contains(cells_[i].c, cells_[i].r) ? 0 : 1;
  }
  return outside > kOpenShare * end;
}

/** The shell of a face's own points: what lies deeper is another part, as the apron below a table's
 * edge [m]. */
double FaceEstimator::shellDepth() const
{
  return std::max(kEndWidth, 4.0 * options_.depthSigma(range_));
}

/** A face that shows by its own points: it is at their median. */
std::optional<FaceEstimate> FaceEstimator::surface(std::size_t face) const
{
  constexpr double kStill = 1e-4;  // [m]
  const auto& across = acrossOf(face);
  FaceEstimate out;
  out.source = FaceSource::Surface;
  out.position = extreme(face) - 0.5 * shellDepth();
  std::vector<double> shell;
  // The outermost points are those that err most: the shell moves inwards to where most are.
  for (double before = extreme(face); before - out.position > kStill;)
  {
    before = out.position;
    shell.clear();
    double shift = 0;
    for (std::size_t i = 0; i < size(); ++i)
      if (cosine(face, i) > kOwnNormal && std::abs(along(face, i) - before) < 0.5 * shellDepth())
      {
        shell.push_back(along(face, i));
        shift += across[i];
      }
    if (shell.empty()) return {};
    out.shift = shift / static_cast<double>(shell.size());
    out.position = median(shell);
  }
  if (shell.size() < kFewestOfSurface) return {};
  out.worth = {
      FaceKind::Measured,
      face == kTop ? topSurfaceSigma(range_, options_) : surfaceSigma(range_, options_)};

  if (face == kTop)
    raiseTop(std::move(shell), out);
  else
    reachOfLeaning(face, out);
  return out;
}

std::optional<FaceEstimator::LeaningSide> FaceEstimator::leaningSide(std::size_t face) const
{
  std::vector<Eigen::Vector2d> own;  // height, and along the outward normal
  for (std::size_t i = 0; i < size(); ++i)
    if (cosine(face, i) > kOwnNormal) own.emplace_back(points_[kTop / 2][i], along(face, i));
  const auto line = fitLine(own, shellDepth());
  if (!line ||
      std::abs(line->angle) < std::max(kUpright, kBeyondChance * std::sqrt(line->variance)))
    return {};
  const double slope = std::tan(line->angle);
  std::vector<double> offsets;
  for (const auto& p : own) offsets.push_back(p.y() - slope * p.x());
  return LeaningSide{line->angle, slope, median(std::move(offsets))};
}

/** Moves a side that leans to its outermost end. */
void FaceEstimator::reachOfLeaning(std::size_t face, FaceEstimate& side) const
{
  const auto leaning = leaningSide(face);
  if (!leaning) return;
  std::vector<double> ends;  // where the plane is at the height of each of its points
  for (std::size_t i = 0; i < size(); ++i)
  {
    const double end = leaning->at(points_[kTop / 2][i]);
    if (cosine(face, i) > kOwnNormal && std::abs(along(face, i) - end) < 0.5 * shellDepth())
      ends.push_back(end);
  }
  if (!ends.empty())
    side.position = std::max(side.position, quantile(std::move(ends), kWithoutRim));
}

std::optional<FrontReach> FaceEstimator::reachOfFront(std::size_t back) const
{
  const std::size_t front = back ^ 1U;
  const auto side = surface(front);
  if (!side) return {};
  const auto leaning = leaningSide(front);
  std::vector<double> reach, behind;  // along the back's normal, the latter from the front on [m]
  for (std::size_t i = 0; i < size(); ++i)
  {
    reach.push_back(along(back, i));
    behind.push_back(reach.back() + (leaning ? leaning->at(points_[kTop / 2][i]) : side->position));
  }
  if (quantile(std::move(behind), kWithoutRim) > shellDepth()) return {};
  FrontReach out{quantile(std::move(reach), kWithoutRim), {}};
  if (leaning) out.lean = leaning->angle;
  return out;
}

/** Moves a top up to its highest parts, equation (8.6). Tops are round, or have raised
 * borders, and what lies above the noise is their end. \param shell Heights of the points that face
 * up [m]. */
void FaceEstimator::raiseTop(std::vector<double> shell, FaceEstimate& top) const
{
  const double noise = std::abs(facingAway(kTop)) * options_.depthSigma(range_);
  const double high = quantile(std::move(shell), kWithoutRim) - normalQuantile(kWithoutRim) * noise;
  if (high <= top.position) return;
  top.worth.sigma = std::hypot(top.worth.sigma, 0.5 * (high - top.position));
  top.position = high;
}

/** Each point tells where the outermost one is, equation (8.7). */
std::optional<FaceEstimate> FaceEstimator::nearSideOfRound(std::size_t face, double radius) const
{
  std::vector<double> outermost;
  for (std::size_t i = 0; i < size(); ++i)
    if (cosine(face, i) > kOwnNormal)
      outermost.push_back(along(face, i) + radius * (1.0 - cosine(face, i)));
  if (outermost.size() < kFewestOfSurface) return {};
  FaceEstimate out;
  out.source = FaceSource::Surface;
  // Leaves lie at all depths, a vase's wall at one.
  const double ragged = std::max(0.0, madSigma(outermost) - options_.depthSigma(range_));
  out.position = median(std::move(outermost)) + ragged;
  out.worth = {FaceKind::Measured, std::hypot(ragged, roundSurfaceSigma(range_, radius, options_))};
  return out;
}

}  // namespace quadmap
