#include "frame/SurfaceRegions.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "quadmap/surfaces/DisjointSets.h"

namespace quadmap
{
namespace
{
// Of two neighbouring cells of one plane:
const float kMinCosine = std::cos(0.10f);  // between the normals
constexpr float kMaxStep = 0.04f;          // between the points, times the squared depth [1/m]
constexpr float kMaxOffset = 0.03f;        // between the planes' offsets, as above [1/m]
constexpr float kMaxRoughness = 0.05f;     // a plane at 3 m shows 0.04 by its noise
constexpr double kMaxCurvature = 0.02;     // of a whole region: share of variance across it

bool isSamePlane(const SurfaceCell& cell, const SurfaceCell& before)
{
  if (!cell.hasPlane() || !before.hasPlane() || cell.roughness >= kMaxRoughness) return false;
  const float z2 = cell.point.z() * cell.point.z();
  return std::abs(cell.offset - before.offset) < kMaxOffset * z2 &&
         cell.normal.dot(before.normal) > kMinCosine &&
         (cell.point - before.point).squaredNorm() < kMaxStep * kMaxStep * z2 * z2;
}

/** Least squares of the distances; nothing when the region is bent. */
std::optional<SurfaceRegion> fitRegion(const SurfaceCells& cells, std::vector<std::size_t> indices)
{
  constexpr std::size_t kEnough = 1500;  // points: their noise is correlated
  const std::size_t step = 1 + indices.size() / kEnough;
  SurfaceRegion out;
  double count = 0;
  for (std::size_t k = 0; k < indices.size(); k += step, ++count)
    out.centroid += cells[indices[k]].point.cast<double>();
  out.centroid /= count;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < indices.size(); k += step)
  {
    const Eigen::Vector3d d = cells[indices[k]].point.cast<double>() - out.centroid;
    covariance += d * d.transpose();
  }
  covariance /= count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  if (!(solver.eigenvalues()[0] < kMaxCurvature * covariance.trace())) return {};
  out.plane = Plane::throughPoint(solver.eigenvectors().col(0).normalized(), out.centroid);
  if (out.plane.d < 0) out.plane = {-out.plane.n, -out.plane.d};  // towards the camera
  out.cells = std::move(indices);
  return out;
}

}  // namespace

std::vector<SurfaceRegion> surfaceRegions(const SurfaceCells& cells, std::size_t minCells)
{
  const auto width = static_cast<std::size_t>(cells.columns());
  DisjointSets sets(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    const int here = static_cast<int>(i);
    if (i % width > 0 && isSamePlane(cells[i], cells[i - 1])) sets.join(here, here - 1);
    if (i >= width && isSamePlane(cells[i], cells[i - width]))
      sets.join(here, here - cells.columns());
  }
  const auto regions = sets.numbers();
  std::vector<std::size_t> count(static_cast<std::size_t>(regions.count), 0);
  for (const int region : regions.of) ++count[static_cast<std::size_t>(region)];
  std::vector<std::size_t> largeOnes(count.size());  // index in `large`
  std::vector<std::vector<std::size_t>> large;
  for (std::size_t region = 0; region < count.size(); ++region)
    if (count[region] > minCells)
    {
      largeOnes[region] = large.size();
      large.emplace_back().reserve(count[region]);
    }
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (const auto region = static_cast<std::size_t>(regions.of[i]); count[region] > minCells)
      large[largeOnes[region]].push_back(i);
  std::vector<SurfaceRegion> out;
  for (auto& indices : large)
    if (auto region = fitRegion(cells, std::move(indices))) out.push_back(std::move(*region));
  std::stable_sort(
      out.begin(), out.end(),
      [](const auto& a, const auto& b) { return a.cells.size() > b.cells.size(); });
  return out;
}

}  // namespace quadmap
