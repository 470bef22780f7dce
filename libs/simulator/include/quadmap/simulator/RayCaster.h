#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "quadmap/geometry/ImageBox.h"
#include "quadmap/simulator/Scene.h"

namespace quadmap::simulator
{
/** An image without noise. All buffers have width * height elements, row major. */
struct RenderedFrame
{
  static constexpr std::int32_t kRoom = -1;

  PinholeCamera camera;
  mrpt::poses::CPose3D T_world_camera;     //!< Camera frame x forward, y left, z up
  double time = 0;                         //!< Of the objects [s since the start]
  double blur = 0;                         //!< Mean length of the motion of the pixels [px]
  std::vector<float> depth;                //!< Along the optical axis [m]
  std::vector<std::int32_t> object;        //!< Index into Scene::objects, or kRoom
  std::vector<float> cosIncidence;         //!< Cosine of the angle between ray and normal
  std::vector<std::uint8_t> returnsDepth;  //!< 0 where the material returns no depth
  std::vector<std::uint8_t> rgb;           //!< Three bytes per pixel
  /** For each object the number of pixels that its outline would cover with nothing in front of it.
   * Pixels outside the image count up to one image size beyond the border. */
  std::vector<double> outlinePixels;
  /** For each object the box of this outline, which is not cut by the border (see outlineBox()). */
  std::vector<std::optional<ImageBox>> outline;
};

/** Renders a scene by ray casting. Intersections are analytic, without errors of sampling. */
class RayCaster
{
 public:
  /** \param scene Must outlive the caster. */
  RayCaster(const Scene& scene, const PinholeCamera& camera) : scene_(scene), camera_(camera) {}

  /** Renders one image. It may run concurrently.
   *  \param T_world_camera Pose of the camera, whose frame is x forward, y left, z up.
   *  \param time Time at which objects are looked up [s since the start]. */
  RenderedFrame render(const mrpt::poses::CPose3D& T_world_camera, double time = 0) const;

 private:
  const Scene& scene_;
  PinholeCamera camera_;
};

}  // namespace quadmap::simulator
