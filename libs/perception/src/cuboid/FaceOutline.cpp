#include <algorithm>
#include <cmath>
#include <limits>

#include "cloud/Precision.h"
#include "cuboid/FaceEstimator.h"
#include "cuboid/FaceSigmas.h"
#include "quadmap/geometry/RobustStatistics.h"

// Faces that show by the outline of the object only (doc/mathematics.md, 8, "Faces").

namespace quadmap
{
namespace
{
/** Extent of the middle 90 % of some values. */
double spread(std::vector<double> values)
{
  if (values.empty()) return 0.0;
  return quantileRange(std::move(values), 0.05).width();
}

}  // namespace

/** Cuts the object into lines of cells that run in the image as the outward normal does. */
FaceEstimator::Outline FaceEstimator::outlineTowards(std::size_t face) const
{
  const Eigen::Vector3d middle = R_obj_optical_.transpose() * centroid_;
  const Eigen::Vector3d ahead = middle + stepTowards(face);
  Outline out;
  const auto& camera = cloud_.camera();
  if (ahead.z() < 0.1) return out;
  const Eigen::Vector2d step =
      (camera.project(ahead) - camera.project(middle)) / static_cast<double>(cloud_.stride());
  const double cells = step.norm();
  out.metresPerCell = kEndSlack / std::max(cells, 1e-3);
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

/** The share of lines that are cut: their last cell is not an end of the object. Only the lines
 * that reach `from` [m] count. */
double FaceEstimator::cutShare(const Outline& outline, std::size_t face, double from) const
{
  const Eigen::Vector3d ahead = stepTowards(face);
  int cut = 0, all = 0;
  for (const auto& line : outline.lines)
  {
    if (line.along < from) break;
    ++all;
    cut += isCut(cells_[line.last], ahead) ? 1 : 0;
  }
  return all > 0 ? static_cast<double>(cut) / all : 1.0;
}

/** How far noise moves the n-th outermost of the points that may lie at a face, equation (8.9) [m].
 */
double FaceEstimator::noiseAt(std::size_t face, double position, std::size_t n) const
{
  constexpr double kReach = 2.0;  // of the noise
  const double sigma = options_.depthSigma(range_), away = facingAway(face);
  const double least = position - kReach * std::abs(away) * sigma;
  std::size_t count = 0;
  for (std::size_t i = 0; i < size(); ++i) count += along(face, i) >= least ? 1 : 0;
  return outlineNoise(away, sigma, n, count);
}

/** A face that shows by its outline only: it is where the lines end, with (8.8) and (8.9). */
FaceEstimate FaceEstimator::outline(std::size_t face, const Outline& outline) const
{
  constexpr double kStrayLines = 0.04;  // share; flying pixels
  FaceEstimate out;
  if (outline.lines.empty())  // right behind the camera's plane
  {
    for (std::size_t i = 0; i < size(); ++i) out.position = std::max(out.position, along(face, i));
    out.worth = {FaceKind::AtLeast, outlineSigma(kEndSlack, range_, options_)};
    return out;
  }
  const std::size_t stray = std::min(
      outline.lines.size() - 1,
      static_cast<std::size_t>(1.0 + kStrayLines * static_cast<double>(outline.lines.size())));
  const double outermost = outline.lines[stray].along;
  const double away = facingAway(face);
  out.source = away > kTurnedAway ? FaceSource::FarEdge : FaceSource::Outline;
  const double perCell = std::min(outline.metresPerCell, kEndSlack);  // coarser ones say nothing
  out.position = outermost + outlineShift(away, perCell) - noiseAt(face, outermost, stray);
  const auto& across = acrossOf(face);
  double count = 0;
  for (const auto& line : outline.lines)
  {
    if (line.along < outermost - kEndWidth) break;
    out.shift += across[line.last];
    ++count;
  }
  out.shift /= count;
  out.isCut = cutShare(outline, face, outermost - kEndWidth) > kOpenShare;
  const bool isOpen = out.isCut || (away > kTurnedAway && !leadsUp(face, outermost));
  out.worth.kind = isOpen ? FaceKind::AtLeast : FaceKind::Measured;
  // A slanted cut leaves few lines their ends; nothing is known beyond them.
  if (isOpen) out.position = std::max(outermost, extreme(face));
  out.worth.sigma = outlineSigmaOf(face, perCell);
  return out;
}

FaceEstimate FaceEstimator::endInBox() const
{
  std::vector<double> down;
  for (std::size_t i = 0; i < size(); ++i)
    if (object_.inBox.contains(cells_[i].c, cells_[i].r)) down.push_back(along(kBottom, i));
  FaceEstimate out;
  out.position = down.empty() ? extreme(kBottom) : quantile(std::move(down), 1.0 - kStrayShare);
  out.isCut = cutShare(outlineTowards(kBottom), kBottom, out.position - kEndWidth) > kOpenShare;
  return out;
}

double FaceEstimator::shareOfLinesBelow(double position) const
{
  const Outline down = outlineTowards(kBottom);
  const auto below = std::count_if(
      down.lines.begin(), down.lines.end(),
      [&](const Line& line) { return line.along > position; });
  return down.lines.empty() ? 0
                            : static_cast<double>(below) / static_cast<double>(down.lines.size());
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
  constexpr double kMinProfile = 0.3, kMinBreadth = 0.35;  // shares, of the rim and of the width
  int profile = 0, rim = 0;
  std::vector<double> depth;
  depth.reserve(size());
  for (std::size_t i = 0; i < size(); ++i)
  {
    if (normals_[0][i] == 0 && normals_[1][i] == 0 && normals_[2][i] == 0) continue;
    const bool inProfile = std::abs(cosine(face, i)) < 0.5;
    if (inProfile) depth.push_back(along(face, i));
    if (along(face, i) < position - kEndWidth) continue;
    ++rim;
    profile += inProfile ? 1 : 0;
  }
  if (profile <= kMinProfile * rim) return false;
  return spread(std::move(depth)) > kMinBreadth * spread(acrossOf(face));
}

/** The part of the image in which depth is measured: that of a camera registered to another one
 * ends before the image does. */
DepthCloud::CellRange FaceEstimator::measuredPart(const DepthCloud& cloud)
{
  constexpr int kMinShare = 10;  // one of so many cells has depth
  constexpr int kWidest = 12;    // one of so many columns or rows is without
  const int columns = cloud.columns(), rows = cloud.rows();
  DepthCloud::CellRange out = {0, 0, columns, rows};
  const auto isBlind = [&](int c, int r, bool isColumn)
  {
    const int count = isColumn ? rows : columns;
    int valid = 0;
    for (int i = 0; i < count; ++i) valid += cloud.valid(isColumn ? c : i, isColumn ? i : r);
    return kMinShare * valid <= count;
  };
  while (out.c0 < columns / kWidest && isBlind(out.c0, 0, true)) ++out.c0;
  while (columns - out.c1 < columns / kWidest && isBlind(out.c1 - 1, 0, true)) --out.c1;
  while (out.r0 < rows / kWidest && isBlind(0, out.r0, false)) ++out.r0;
  while (rows - out.r1 < rows / kWidest && isBlind(0, out.r1 - 1, false)) --out.r1;
  return {out.c0 + kMixedCells, out.r0 + kMixedCells, out.c1 - kMixedCells, out.r1 - kMixedCells};
}

/** What the image shows next to a cell at the rim of the object. */
FaceEstimator::Beyond FaceEstimator::beyond(
    const ObjectCloud::Cell& cell, const Eigen::Vector3d& ahead_optical) const
{
  const Eigen::Vector3d p = cloud_.point(cell.c, cell.r).cast<double>();
  const Eigen::Vector3d ahead = p + ahead_optical;
  if (ahead.z() < 0.05) return {Beyond::Border, p};
  const auto& camera = cloud_.camera();
  const Eigen::Vector2d step = camera.project(ahead) - camera.project(p);
  if (step.norm() < 1e-6) return {Beyond::Background, p};
  const Eigen::Vector2d direction = step.normalized();
  constexpr int kReach = 10;  // cells
  for (int i = 1; i <= kReach; ++i)
  {
    const int c = static_cast<int>(cell.c + i * direction.x() + 0.5);  // rounded where it is inside
    const int r = static_cast<int>(cell.r + i * direction.y() + 0.5);
    if (!measured_.contains(c, r)) return {Beyond::Border, p};
    if (object_.mask.contains(c, r) || !cloud_.valid(c, r) || cloud_.isFlyingPixel(c, r)) continue;
    const Eigen::Vector3d q = cloud_.point(c, r).cast<double>();
    const double noise = kBeyondChance * options_.depthSigma(p.z());
    const bool isNearer = !isOnSupport(q, noise) && q.z() < p.z() + kEndWidth + noise;
    return {isNearer ? Beyond::Nearer : Beyond::Background, q};
  }
  return {Beyond::Background, p};
}

std::optional<double> FaceEstimator::distanceOfWhatHidesFoot() const
{
  const Eigen::Vector3d ahead = stepTowards(kBottom);
  const Outline lines = outlineTowards(kBottom);
  std::vector<double> distances;
  for (const auto& line : lines.lines)
  {
    const auto& cell = cells_[line.last];
    const Beyond next = beyond(cell, ahead);
    if (next.kind != Beyond::Nearer) continue;
    const Eigen::Vector3d gap =
        R_obj_optical_ * (next.point - cloud_.point(cell.c, cell.r).cast<double>());
    distances.push_back(gap.head<2>().norm());
  }
  if (2 * distances.size() <= lines.lines.size()) return {};
  return median(std::move(distances));
}

}  // namespace quadmap
