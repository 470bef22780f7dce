#include "SurfaceRegions.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

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

/** Sets that are joined one by one. */
class DisjointSets
{
 public:
  explicit DisjointSets(std::size_t count) : parent_(count)
  {
    std::iota(parent_.begin(), parent_.end(), std::size_t(0));
  }
  std::size_t rootOf(std::size_t i)
  {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j)
  {
    const std::size_t a = rootOf(i), b = rootOf(j);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;  // never a later one; its own: a root
};

/** Least squares of the distances; nothing when the region is bent. */
std::optional<SurfaceRegion> fitRegion(const SurfaceCells& cells, std::vector<std::size_t> indices)
{
  SurfaceRegion out;
  const double count = static_cast<double>(indices.size());
  for (const std::size_t i : indices) out.centroid += cells[i].point.cast<double>() / count;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::size_t i : indices)
  {
    const Eigen::Vector3d d = cells[i].point.cast<double>() - out.centroid;
    covariance += d * d.transpose() / count;
  }
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
    if (i % width > 0 && isSamePlane(cells[i], cells[i - 1])) sets.join(i, i - 1);
    if (i >= width && isSamePlane(cells[i], cells[i - width])) sets.join(i, i - width);
  }
  std::vector<std::size_t> count(cells.size(), 0);
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i].hasPlane()) ++count[sets.rootOf(i)];
  std::vector<std::vector<std::size_t>> large;
  std::vector<int> number(cells.size(), -1);  // in `large`, of the root of a region
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    if (!cells[i].hasPlane()) continue;
    const std::size_t root = sets.rootOf(i);  // never a later one
    if (count[root] <= minCells) continue;
    if (i == root)
    {
      number[root] = static_cast<int>(large.size());
      large.emplace_back().reserve(count[root]);
    }
    large[static_cast<std::size_t>(number[root])].push_back(i);
  }
  std::vector<SurfaceRegion> out;
  for (auto& indices : large)
    if (auto region = fitRegion(cells, std::move(indices))) out.push_back(std::move(*region));
  std::stable_sort(
      out.begin(), out.end(),
      [](const auto& a, const auto& b) { return a.cells.size() > b.cells.size(); });
  return out;
}

}  // namespace quadmap
