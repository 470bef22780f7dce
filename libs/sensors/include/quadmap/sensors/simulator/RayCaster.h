#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "quadmap/geometry/ImageBox.h"
#include "quadmap/sensors/simulator/Scene.h"

namespace quadmap::simulator
{
/** An image without any noise; all buffers are row major, width * height. */
struct RenderedFrame
{
  static constexpr std::int32_t kRoom = -1;

  PinholeCamera camera;
  std::vector<float> depth;                //!< Along the optical axis [m]
  std::vector<std::int32_t> object;        //!< Index into Scene::objects, or kRoom
  std::vector<float> cosIncidence;         //!< Of the angle between ray and surface normal
  std::vector<std::uint8_t> returnsDepth;  //!< 0 where the material gives none
  std::vector<std::uint8_t> rgb;           //!< Three bytes per pixel
  /** For each object the pixels its outline would cover with nothing in front of it, those outside
   * the image included (to one image size beyond its borders). */
  std::vector<double> outlinePixels;
  /** For each object the box of that outline, the image's borders ignored (see outlineBox()). */
  std::vector<std::optional<ImageBox>> outline;
};

/** Renders a scene by ray casting: analytic intersections, no sampling errors. */
class RayCaster
{
 public:
  /** \param scene Must outlive the caster. */
  RayCaster(const Scene& scene, const PinholeCamera& camera) : scene_(scene), camera_(camera) {}

  /** May run concurrently. \param T_world_camera Camera frame x forward, y left, z up.
   *  \param time Of what stands where [s since the start]. */
  RenderedFrame render(const mrpt::poses::CPose3D& T_world_camera, double time = 0) const;

 private:
  const Scene& scene_;
  PinholeCamera camera_;
};

}  // namespace quadmap::simulator
