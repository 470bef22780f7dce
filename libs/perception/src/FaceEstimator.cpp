#include "FaceEstimator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "FaceSigmas.h"
#include "quadmap/geometry/RobustStatistics.h"

namespace quadmap
{
namespace
{
constexpr double kTailShare = 0.005;  // of the points, cut as stray ones
constexpr std::size_t kTop = 4, kBottom = 5;

/** Extent of the middle 90 % of some values. */
double spread(std::vector<double> values)
{
  if (values.empty()) return 0.0;
  return quantileRange(std::move(values), 0.05).width();
}

}  // namespace

FaceEstimator::FaceEstimator(
    const DepthCloud& cloud,
    const ScenePlanes& planes,
    const ObjectCloud& object,
    const LevelCloud& level,
    double yaw,
    const PerceptionOptions& options) :
    cloud_(cloud),
    planes_(planes),
    object_(object),
    options_(options),
    range_(level.medianRange),
    cells_(level.cells)
{
  R_obj_optical_ =
      Eigen::AngleAxisd(-yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix() * level.R_level_optical;
  const Eigen::Matrix3d R_obj_level = R_obj_optical_ * level.R_level_optical.transpose();
  for (const std::size_t axis : {0, 1, 2})
  {
    points_[axis].resize(size());
    normals_[axis].resize(size());
  }
  for (std::size_t i = 0; i < size(); ++i)
  {
    const Eigen::Vector3d p = R_obj_level * level.points[i];
    Eigen::Vector3d n = Eigen::Vector3d::Zero();
    if (level.normals[i]) n = R_obj_level * *level.normals[i];
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

double FaceEstimator::lowestSeen() const { return -extreme(kBottom); }

bool FaceEstimator::isFootInSight() const
{
  constexpr double kLowest = 0.98, kMaxHidden = 0.3;  // quantile; share of what lies below it
  const Eigen::Vector3d middle = R_obj_optical_.transpose() * centroid_;
  const Eigen::Vector3d lower = middle + 0.05 * R_obj_optical_.transpose() * normalOf(kBottom);
  const Eigen::Vector2d down = cloud_.camera().project(lower) - cloud_.camera().project(middle);
  std::vector<double> visible;
  for (const auto& cell : cells_) visible.push_back(down.dot(Eigen::Vector2d(cell.c, cell.r)));
  const double lowest = quantile(std::move(visible), kLowest);
  const double tolerance = 3.0 * options_.depthSigma(range_);
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
  return hidden < kMaxHidden * below;
}

bool FaceEstimator::isOnSupport(const Eigen::Vector3d& p, double tolerance) const
{
  constexpr double kUneven = 0.03;  // [m]
  return object_.support &&
         std::abs(planes_.plane(*object_.support).plane.signedDistance(p)) < kUneven + tolerance;
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

/** Does a cloud that goes on outside the detector's box end there, too, on this side? Then it is
 * another thing's end, of one that touches the object. */
bool FaceEstimator::endsOutsideBox(std::size_t face) const
{
  constexpr double kEnd = 0.02, kMaxOutside = 0.3;  // [m], share of the end's points
  if (object_.leak == 0) return false;
  int end = 0, outside = 0;
  for (std::size_t i = 0; i < size(); ++i)
  {
    if (along(face, i) < extreme(face) - kEnd) continue;
    ++end;
    outside += object_.inBox.contains(cells_[i].c, cells_[i].r) ? 0 : 1;
  }
  return outside > kMaxOutside * end;
}

std::optional<FaceEstimate> FaceEstimator::surface(std::size_t face) const
{
  constexpr double kMinCosine = 0.85;
  // What lies deeper is another part (the apron below a table's edge).
  const double shellDepth = std::max(0.03, 4.0 * options_.depthSigma(range_));  // [m]
  const auto& across = acrossOf(face);
  std::vector<double> shell;
  double shift = 0;
  for (std::size_t i = 0; i < size(); ++i)
    if (cosine(face, i) > kMinCosine && along(face, i) > extreme(face) - shellDepth)
    {
      shell.push_back(along(face, i));
      shift += across[i];
    }
  const double count = static_cast<double>(shell.size());
  if (count < std::max(20.0, 0.03 * static_cast<double>(size()))) return {};
  FaceEstimate out;
  out.source = FaceSource::Surface;
  out.shift = shift / count;
  out.position = median(shell);
  out.worth = {
      FaceKind::Measured,
      face == kTop ? topSurfaceSigma(range_, options_) : surfaceSigma(range_, options_)};

  if (face == kTop) raiseTop(std::move(shell), out);
  return out;
}

/** Tops are round, or have rims and handles: what lies above the noise is their end.
 * \param shell Heights of the points that face up. */
void FaceEstimator::raiseTop(std::vector<double> shell, FaceEstimate& top) const
{
  const double depthSigma = options_.depthSigma(range_);
  const double count = static_cast<double>(shell.size());
  const double noise = std::max(madSigma(shell), depthSigma);
  constexpr double kMost = 0.95, kMostSigmas = 1.64;
  const double high =
      quantile(std::move(shell), kMost) - kMostSigmas * std::abs(facingAway(kTop)) * depthSigma;
  if (high > top.position)
  {
    top.worth.sigma = std::hypot(top.worth.sigma, 0.5 * (high - top.position));
    top.position = high;
  }
  constexpr double kMinOut = 0.01, kMinShare = 0.01;  // [m], of the surface
  std::vector<double> beyond;
  for (const double x : points_[kTop / 2])
    if (x > top.position + std::max(kMinOut, 3.5 * noise)) beyond.push_back(x);
  if (static_cast<double>(beyond.size()) > std::max(6.0, kMinShare * count))
  {
    top.position = quantile(std::move(beyond), 0.9);
    top.worth.sigma = std::hypot(top.worth.sigma, protrusionSigma(cell()));
  }
}

std::optional<FaceEstimate> FaceEstimator::nearSideOfRound(std::size_t face, double radius) const
{
  constexpr double kMinCosine = 0.85, kMinPoints = 20;
  std::vector<double> outermost;
  for (std::size_t i = 0; i < size(); ++i)
    if (cosine(face, i) > kMinCosine)
      outermost.push_back(along(face, i) + radius * (1.0 - cosine(face, i)));
  if (static_cast<double>(outermost.size()) < kMinPoints) return {};
  FaceEstimate out;
  out.source = FaceSource::Surface;
  // Leaves lie at all depths, a vase's wall at one.
  const double ragged = std::max(0.0, madSigma(outermost) - options_.depthSigma(range_));
  out.position = median(std::move(outermost)) + ragged;
  out.worth = {FaceKind::Measured, std::hypot(ragged, roundSurfaceSigma(range_, radius, options_))};
  return out;
}

/** Cuts the object into lines of cells that run in the image as the outward normal does. */
FaceEstimator::Outline FaceEstimator::outlineTowards(std::size_t face) const
{
  constexpr double kStep = 0.05;  // [m]
  const Eigen::Vector3d n = normalOf(face);
  const Eigen::Vector3d middle = R_obj_optical_.transpose() * centroid_;
  const Eigen::Vector3d ahead = middle + kStep * R_obj_optical_.transpose() * n;
  Outline out;
  const auto& camera = cloud_.camera();
  if (ahead.z() < 0.1) return out;
  const Eigen::Vector2d step =
      (camera.project(ahead) - camera.project(middle)) / static_cast<double>(cloud_.stride());
  const double cells = step.norm();
  out.metresPerCell = kStep / std::max(cells, 1e-3);
  const Eigen::Vector2d across(-step.y() / std::max(cells, 1e-9), step.x() / std::max(cells, 1e-9));

  // No cell is farther from the first line than the image is long, either way.
  const int reach = cloud_.columns() + cloud_.rows();
  constexpr double kNothing = -std::numeric_limits<double>::infinity();
  std::vector<Line> lines(static_cast<std::size_t>(2 * reach), Line{0, kNothing});
  for (std::size_t i = 0; i < size(); ++i)
  {
    const double number = across.x() * cells_[i].c + across.y() * cells_[i].r + reach;  // > 0
    Line& line = lines[static_cast<std::size_t>(number)];
    if (along(face, i) > line.along) line = {i, along(face, i)};
  }
  for (const auto& line : lines)
    if (line.along > kNothing) out.lines.push_back(line);
  std::sort(
      out.lines.begin(), out.lines.end(),
      [](const Line& a, const Line& b) { return a.along > b.along; });
  return out;
}

/** Share of the lines reaching `from` at least whose end is not the object's. */
double FaceEstimator::cutShare(const Outline& outline, std::size_t face, double from) const
{
  const Eigen::Vector3d ahead = 0.05 * R_obj_optical_.transpose() * normalOf(face);
  int cut = 0, all = 0;
  for (const auto& line : outline.lines)
  {
    if (line.along < from) break;
    ++all;
    cut += isCut(cells_[line.last], ahead) ? 1 : 0;
  }
  return all > 0 ? static_cast<double>(cut) / all : 1.0;
}

/** How far noise moves the n-th outermost of the points that may lie at a face. */
double FaceEstimator::noiseAt(std::size_t face, double position, std::size_t n) const
{
  constexpr double kReach = 2.0;  // of the noise
  const double sigma = options_.depthSigma(range_), away = facingAway(face);
  const double least = position - kReach * std::abs(away) * sigma;
  std::size_t count = 0;
  for (std::size_t i = 0; i < size(); ++i) count += along(face, i) >= least ? 1 : 0;
  return outlineNoise(away, sigma, n, count);
}

/** A face that shows by its outline only. */
FaceEstimate FaceEstimator::outline(std::size_t face, const Outline& outline) const
{
  constexpr double kRim = 0.03, kMaxCut = 0.3;  // [m], share
  constexpr double kStrayLines = 0.04;          // share; flying pixels
  constexpr double kMaxMetresPerCell = 0.05;    // coarser outlines say nothing [m]
  FaceEstimate out;
  if (outline.lines.empty())  // right behind the camera's plane
  {
    for (std::size_t i = 0; i < size(); ++i) out.position = std::max(out.position, along(face, i));
    out.worth = {FaceKind::AtLeast, outlineSigma(kMaxMetresPerCell, range_, options_)};
    return out;
  }
  const std::size_t stray = std::min(
      outline.lines.size() - 1,
      static_cast<std::size_t>(1.0 + kStrayLines * static_cast<double>(outline.lines.size())));
  const double outermost = outline.lines[stray].along;
  const double away = facingAway(face);
  out.source = away > kTurnedAway ? FaceSource::FarEdge : FaceSource::Outline;
  const double perCell = std::min(outline.metresPerCell, kMaxMetresPerCell);
  out.position = outermost + outlineShift(away, perCell) - noiseAt(face, outermost, stray);
  const auto& across = acrossOf(face);
  double count = 0;
  for (const auto& line : outline.lines)
  {
    if (line.along < outermost - kRim) break;
    out.shift += across[line.last];
    ++count;
  }
  out.shift /= count;
  const bool isOpen = cutShare(outline, face, outermost - kRim) > kMaxCut ||
                      (away > kTurnedAway && !leadsUp(face, outermost));
  out.worth.kind = isOpen ? FaceKind::AtLeast : FaceKind::Measured;
  // A slanted cut leaves few lines their ends; nothing is known beyond them.
  if (isOpen) out.position = std::max(outermost, extreme(face));
  out.worth.sigma = outlineSigmaOf(face, perCell);
  return out;
}

double FaceEstimator::outlineSigmaOf(std::size_t face, double perCell) const
{
  const double away = facingAway(face);
  if (face == kTop && away < -kTurnedAway) return topFromAboveSigma(perCell, range_, options_);
  if (face == kTop) return topEdgeSigma(perCell, range_, options_);
  if (away > kTurnedAway) return farEdgeSigma(perCell, range_, options_);
  return outlineSigma(perCell, range_, options_);
}

/** A side that is turned away counts when a surface is seen that leads up to it and that is no mere
 * rim, as the top of a cabinet for its back; the back of a chair hides what is behind it. */
bool FaceEstimator::leadsUp(std::size_t face, double position) const
{
  constexpr double kRim = 0.03, kMinProfile = 0.3, kMinDepth = 0.05;  // [m], share, [m]
  constexpr double kMinBreadth = 0.35;                                // of the width across
  int profile = 0, rim = 0;
  std::vector<double> depth;
  depth.reserve(size());
  for (std::size_t i = 0; i < size(); ++i)
  {
    if (normals_[0][i] == 0 && normals_[1][i] == 0 && normals_[2][i] == 0) continue;
    const bool inProfile = std::abs(cosine(face, i)) < 0.5;
    if (inProfile) depth.push_back(along(face, i));
    if (along(face, i) < position - kRim) continue;
    ++rim;
    profile += inProfile ? 1 : 0;
  }
  if (profile <= kMinProfile * rim) return false;
  const double deep = spread(std::move(depth));
  return deep > kMinDepth && deep > kMinBreadth * spread(acrossOf(face));
}

/** Does the object go on beyond a cell at its rim: at the image border, behind something nearer, or
 * on a surface that the box or the cluster cut off? \param ahead_optical Where it would go on. */
bool FaceEstimator::isCut(const ObjectCloud::Cell& cell, const Eigen::Vector3d& ahead_optical) const
{
  const Eigen::Vector3d p = cloud_.point(cell.c, cell.r).cast<double>();
  const Eigen::Vector3d ahead = p + ahead_optical;
  if (ahead.z() < 0.05) return true;
  const auto& camera = cloud_.camera();
  const Eigen::Vector2d step = camera.project(ahead) - camera.project(p);
  if (step.norm() < 1e-6) return false;
  const Eigen::Vector2d direction = step.normalized();
  constexpr int kReach = 10;  // cells
  constexpr int kBorder = 3;  // cells; the sensor's own rim is empty
  for (int i = 1; i <= kReach; ++i)
  {
    const int c = static_cast<int>(cell.c + i * direction.x() + 0.5);  // rounded where it is inside
    const int r = static_cast<int>(cell.r + i * direction.y() + 0.5);
    if (c < kBorder || r < kBorder || c >= cloud_.columns() - kBorder ||
        r >= cloud_.rows() - kBorder)
      return true;
    if (object_.mask.contains(c, r) || !cloud_.valid(c, r) || cloud_.isFlyingPixel(c, r)) continue;
    const Eigen::Vector3d q = cloud_.point(c, r).cast<double>();
    const double noise = 3.0 * options_.depthSigma(p.z());
    return !isOnSupport(q, noise) && q.z() < p.z() + 0.03 + noise;
  }
  return false;
}

}  // namespace quadmap
