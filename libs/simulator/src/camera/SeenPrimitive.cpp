#include "camera/SeenPrimitive.h"

#include <cmath>

namespace quadmap::simulator
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
constexpr double kNearCorner = 0.01;  // nearer corners give no tight bounds [m]

/** The image with a margin of one image size all around. */
PixelRect surroundings(const PinholeCamera& camera)
{
  const int w = static_cast<int>(camera.width), h = static_cast<int>(camera.height);
  return {-w, -h, 2 * w, 2 * h};
}

}  // namespace

Matrix3d inverseOf(const PinholeCamera& camera)
{
  Matrix3d rays;
  rays << 1 / camera.fx, 0, -camera.cx / camera.fx,  //
      0, 1 / camera.fy, -camera.cy / camera.fy,      //
      0, 0, 1;
  return rays;
}

PixelRect boundsOf(const SeenPrimitive& seen, const PinholeCamera& camera)
{
  const Matrix3d P = seen.D.inverse();  // `prim` directions to (u z, v z, z)
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  int behind = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vector3d sign((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
    const Vector3d p = P * (sign.cwiseProduct(seen.primitive->halfSize) - seen.o);
    if (p.z() < kNearCorner)
      ++behind;
    else
    {
      low = low.cwiseMin(p.head<2>() / p.z());
      high = high.cwiseMax(p.head<2>() / p.z());
    }
  }
  if (behind == 8) return {};
  const PixelRect everything = surroundings(camera);
  if (behind > 0) return everything;
  const auto pixel = [](double x)
  { return static_cast<int>(std::floor(std::clamp(x, -1e6, 1e6))); };
  const PixelRect tight{pixel(low.x()), pixel(low.y()), pixel(high.x()) + 2, pixel(high.y()) + 2};
  return tight.clipped(everything);
}

}  // namespace quadmap::simulator
