#include "frame/SurfaceCells.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
namespace
{
constexpr int kBorder = 8;      // cells at the image's border, where sensors are poor, get no plane
constexpr int kWindow = 8;      // cells, the width of what a plane is fitted to; and ...
constexpr float kWider = 0.1f;  // ... this much more per metre of depth [1/m]
constexpr int kWidest = 9;
constexpr int kNarrowest = 2;  // fewer cells make no plane

// Distances are counted in fifths of a cell: 5 to the next one, 7 diagonally.
constexpr int kUnit = 5, kDiagonal = 7, kFar = kUnit * (kWidest + 1);

/** Two neighbouring cells of one surface differ by less in depth [m]. */
float jumpTolerance(float z) { return 0.06f * (1.0f + z); }

/** Sets the distance of each of some cells and of that `step` farther to 0 unless both show one
 * surface. \param z Depths [m], 0 for none: of `count + step` cells. */
void markJumps(const float* z, std::size_t step, std::size_t count, int* distance)
{
  std::vector<int> isOne(count);  // surface: all bits set
  for (std::size_t i = 0; i < count; ++i)
  {
    const float a = z[i], b = z[i + step];
    const bool haveDepth = std::min(a, b) > 0, areNear = std::abs(a - b) <= jumpTolerance(a);
    isOne[i] = -static_cast<int>(haveDepth & areNear);
  }
  for (std::size_t i = 0; i < count; ++i) distance[i] &= isOne[i];
  for (std::size_t i = 0; i < count; ++i) distance[i + step] &= isOne[i];
}

/** Sums over all cells above and to the left, of the inverse depth q, its square, and q times
 * column and row. Only those of the last rows are kept: they stay in the processor's cache. */
class Sums
{
 public:
  explicit Sums(int columns) :
      width_(static_cast<std::size_t>(columns) + 1), sums_(width_ * kRows, Eigen::Vector4d::Zero())
  {
  }

  /** Adds the next row. \param cells All of it. */
  void add(int r, const SurfaceCell* cells)
  {
    const Eigen::Vector4d* above = &sums_[index(0, r)];
    Eigen::Vector4d* here = &sums_[index(0, r + 1)];
    // One number at a time: put together into a vector they would have to wait for memory.
    double sum = 0, columns = 0, rows = 0, squares = 0;
    for (std::size_t c = 0; c + 1 < width_; ++c)
    {
      const double q = cells[c].hasDepth() ? 1.0 / double(cells[c].point.z()) : 0.0;
      here[c + 1][0] = above[c + 1][0] + (sum += q);
      here[c + 1][1] = above[c + 1][1] + (columns += q * static_cast<double>(c));
      here[c + 1][2] = above[c + 1][2] + (rows += q * r);
      here[c + 1][3] = above[c + 1][3] + (squares += q * q);
    }
  }

  Eigen::Vector4d over(int c, int r, int width) const
  {
    return sums_[index(c + width, r + width)] - sums_[index(c, r + width)] -
           sums_[index(c + width, r)] + sums_[index(c, r)];
  }

 private:
  static constexpr unsigned kRows = 16;  // > kWidest
  std::size_t index(int c, int r) const
  {
    return static_cast<unsigned>(r) % kRows * width_ + static_cast<std::size_t>(c);
  }

  std::size_t width_;
  std::vector<Eigen::Vector4d> sums_;
};

/** The rays of the cells: (x, y, 1) = first + (column, row) * step. */
struct Rays
{
  Eigen::Vector2d first, step, cells;  // cells: per unit of a ray, 1 / step

  explicit Rays(const DepthCloud& cloud)
  {
    const auto& camera = cloud.camera();
    const double pixels = SurfaceCells::kStride * cloud.stride();
    first = {-camera.cx / camera.fx, -camera.cy / camera.fy};
    step = {pixels / camera.fx, pixels / camera.fy};
    cells = step.cwiseInverse();
  }
};

/** Fits the plane of a full window of cells by linear regression, equation (5.1). The inverse depth
 * of a plane is linear in the image, q = N.ray, and the noise of depth cameras is even in it.
 * \param c, r First column and row. */
void fitPlane(const Sums& sums, const Rays& rays, int c, int r, int width, SurfaceCell& cell)
{
  const Eigen::Vector4d sum = sums.over(c, r, width);
  const double w2 = width * width, variance = (w2 - 1.0) / 12.0;  // of the columns, of the rows
  const Eigen::Vector2d middle(c + 0.5 * (width - 1), r + 0.5 * (width - 1));
  const Eigen::Vector4d mean = sum * (1.0 / w2);
  const double q = mean[0];
  const Eigen::Vector2d slope = (mean.segment<2>(1) - q * middle) * (1.0 / variance);  // per cell
  const double residual =
      std::max(0.0, mean[3] - q * q - variance * slope.squaredNorm());  // mean square, of q

  const Eigen::Vector2d ray = rays.first + middle.cwiseProduct(rays.step);
  const Eigen::Vector2d n = slope.cwiseProduct(rays.cells);
  const Eigen::Vector3d N(n.x(), n.y(), q - n.dot(ray));
  const double offset = 1.0 / N.norm(), z = 1.0 / q;
  cell.normal = (-offset * N).cast<float>();
  cell.offset = static_cast<float>(offset);

  // Across the plane a change dq of the inverse depth is z * offset * dq [m]; along it the points
  // are spread by their columns and rows.
  const double across = z * z * offset * offset * residual;
  double along = 0;
  for (const int axis : {0, 1})
  {
    const double tilt = z * n[axis], straight = 1.0 - tilt * ray[axis];
    const double other = tilt * ray[1 - axis], metres = z * rays.step[axis];
    along += metres * metres * (straight * straight + other * other + tilt * tilt);
  }
  cell.roughness = static_cast<float>(across / (across + variance * along));
}

}  // namespace

SurfaceCells::SurfaceCells(const DepthCloud& cloud) :
    columns_(cloud.columns() / kStride), rows_(cloud.rows() / kStride)
{
  cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  std::size_t i = 0;
  for (int r = 0; r < rows_; ++r)
    for (int c = 0; c < columns_; ++c, ++i)
      if (cloud.valid(c * kStride, r * kStride))
        cells_[i].point = cloud.point(c * kStride, r * kStride);
  if (columns_ > 2 * kBorder && rows_ > 2 * kBorder) fitPlanes(cloud);
}

/** Of each cell the distance to the nearest that lies beside a jump in depth or has none; at most
 * kFar. */
std::vector<int> SurfaceCells::distancesToJumps() const
{
  // Loops without branches over plain numbers, which the compiler makes four steps at a time of.
  const auto width = static_cast<std::size_t>(columns_), height = static_cast<std::size_t>(rows_);
  std::vector<float> z(cells_.size());
  for (std::size_t i = 0; i < z.size(); ++i) z[i] = cells_[i].point.z();
  std::vector<int> distance(cells_.size(), kFar);
  for (std::size_t r = 0; r < height; ++r)
    markJumps(&z[r * width], 1, width - 1, &distance[r * width]);
  markJumps(z.data(), width, z.size() - width, distance.data());
  // From above and from below; the ends of rows stay as they are.
  const auto spread = [&](int* row, const int* other)
  {
    for (std::size_t c = 1; c + 1 < width; ++c)
    {
      const int diagonally = std::min(other[c - 1], other[c + 1]) + kDiagonal;
      row[c] = std::min(std::min(row[c], other[c] + kUnit), diagonally);
    }
  };
  for (std::size_t r = 1; r < height; ++r)
  {
    int* row = &distance[r * width];
    spread(row, row - width);
    for (std::size_t c = 1; c + 1 < width; ++c) row[c] = std::min(row[c], row[c - 1] + kUnit);
  }
  for (std::size_t r = height - 1; r-- > 0;)
  {
    int* row = &distance[r * width];
    spread(row, row + width);
    for (std::size_t c = width - 1; c-- > 1;) row[c] = std::min(row[c], row[c + 1] + kUnit);
  }
  return distance;
}

void SurfaceCells::fitPlanes(const DepthCloud& cloud)
{
  const Rays rays(cloud);
  const auto distance = distancesToJumps();
  Sums sums(columns_);
  const auto cellAt = [&](int c, int r)
  { return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + std::size_t(c); };
  int summed = 0;  // rows
  for (int r = kBorder; r < rows_ - kBorder; ++r)
  {
    for (; summed <= r + kWidest / 2; ++summed) sums.add(summed, &cells_[cellAt(0, summed)]);
    for (int c = kBorder; c < columns_ - kBorder; ++c)
    {
      const std::size_t i = cellAt(c, r);
      if (distance[i] <= kNarrowest * kUnit) continue;
      const float z = cells_[i].point.z();
      const int wanted = std::min(kWidest, static_cast<int>(kWindow + kWider * z));
      const int width = std::min(distance[i] / kUnit, wanted);
      fitPlane(sums, rays, c - width / 2, r - width / 2, width, cells_[i]);
    }
  }
}

}  // namespace quadmap
