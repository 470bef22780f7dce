#include "camera/SurfaceTexture.h"

#include <cmath>
#include <cstdint>

namespace quadmap::simulator
{
namespace
{
/** A pseudo-random value in [0, 1) of a cell of the integer grid. */
double cellValue(std::int64_t x, std::int64_t y, std::int64_t z)
{
  auto h = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15ULL ^
           static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fULL ^
           static_cast<std::uint64_t>(z) * 0x165667b19e3779f9ULL;
  h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9ULL;
  h ^= h >> 32;
  return static_cast<double>(h >> 11) * 0x1p-53;
}

std::int64_t cell(double x) { return static_cast<std::int64_t>(std::floor(x)); }

/** Smooth noise in [-1, 1] with one cell per unit length. */
double smoothNoise(const Eigen::Vector3d& p)
{
  const std::int64_t x = cell(p.x()), y = cell(p.y()), z = cell(p.z());
  const auto ease = [](double f) { return f * f * (3 - 2 * f); };
  const double fx = ease(p.x() - static_cast<double>(x));
  const double fy = ease(p.y() - static_cast<double>(y));
  const double fz = ease(p.z() - static_cast<double>(z));
  const auto alongX = [&](int dy, int dz)
  {
    const double a = cellValue(x, y + dy, z + dz), b = cellValue(x + 1, y + dy, z + dz);
    return a + fx * (b - a);
  };
  const auto alongY = [&](int dz)
  {
    const double a = alongX(0, dz), b = alongX(1, dz);
    return a + fy * (b - a);
  };
  const double a = alongY(0), b = alongY(1);
  return 2 * (a + fz * (b - a)) - 1;
}

/** Clouds of two sizes, in [-1, 1]. */
double clouds(const Eigen::Vector3d& q)
{
  return 0.6 * smoothNoise(q) + 0.4 * smoothNoise(3.7 * q + Eigen::Vector3d(9.2, 3.1, 5.7));
}

/** Tiles of alternating brightness, each with its own shade, in [-1, 1]. */
double checker(const Eigen::Vector3d& q)
{
  // The offset keeps surfaces in coordinate planes from flickering between two cells.
  const Eigen::Vector3d inside = q + Eigen::Vector3d::Constant(1e-4);
  const std::int64_t x = cell(inside.x()), y = cell(inside.y()), z = cell(inside.z());
  const double parity = ((x + y + z) & 1) != 0 ? 1 : -1;
  const double shade = 2 * cellValue(x, y, z) - 1;
  return 0.55 * parity + 0.3 * shade + 0.15 * smoothNoise(6 * q);
}

/** Planks along x, side by side in y, with grain; in [-1, 1]. */
double stripes(const Eigen::Vector3d& q)
{
  const double plank = 2 * cellValue(cell(0.13 * q.x()), cell(q.y() + 1e-4), 0) - 1;
  const Eigen::Vector3d along(0.4 * q.x(), 5 * q.y(), 5 * q.z());
  return 0.5 * plank + 0.5 * smoothNoise(along);
}

}  // namespace

double textureBrightness(const Material& material, const Eigen::Vector3d& p)
{
  const Eigen::Vector3d q = p / material.scale;
  switch (material.pattern)
  {
    case Pattern::Checker:
      return 1 + material.contrast * checker(q);
    case Pattern::Stripes:
      return 1 + material.contrast * stripes(q);
    case Pattern::Mottled:
      break;
  }
  return 1 + material.contrast * clouds(q);
}

}  // namespace quadmap::simulator
