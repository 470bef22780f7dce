#include "quadmap/simulator/RayCaster.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "camera/SeenPrimitive.h"
#include "camera/Silhouette.h"
#include "camera/SurfaceTexture.h"

namespace quadmap::simulator
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kOutsideStep = 4;  // every 4th ray of every 4th row outside the image

/** Renders one frame into the buffers of the result. */
class FrameRenderer
{
 public:
  FrameRenderer(
      const Scene& scene,
      const PinholeCamera& camera,
      const mrpt::poses::CPose3D& pose,
      double time) :
      scene_(scene),
      time_(time),
      T_world_camera_(pose),
      T_world_optical_(pose + T_sensor_optical()),
      rays_(inverseOf(camera)),
      width_(static_cast<int>(camera.width)),
      height_(static_cast<int>(camera.height))
  {
    const std::size_t pixels = std::size_t{camera.width} * camera.height;
    out_.camera = camera;
    out_.T_world_camera = pose;
    out_.time = time;
    out_.depth.resize(pixels);
    out_.object.assign(pixels, RenderedFrame::kRoom);
    out_.cosIncidence.resize(pixels);
    out_.returnsDepth.resize(pixels);
    out_.rgb.resize(3 * pixels);
    part_.resize(pixels);
    touchedBy_.assign(pixels, RenderedFrame::kRoom);
  }

  RenderedFrame render()
  {
    castRoom();
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) castObject(static_cast<int>(i));
    shade();
    return std::move(out_);
  }

 private:
  std::size_t index(int u, int v) const
  {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(u);
  }

  /** Casts rays at the room. The camera is inside, so that each ray meets the nearest of the three
   * planes that it runs towards. */
  void castRoom()
  {
    const Matrix3d D = T_world_optical_.R * rays_;
    const Vector3d low(-scene_.room.size.x() / 2, -scene_.room.size.y() / 2, 0);
    const Vector3d high(scene_.room.size.x() / 2, scene_.room.size.y() / 2, scene_.room.size.z());
    for (int v = 0; v < height_; ++v)
      for (int u = 0; u < width_; ++u)
      {
        const Vector3d d = D * Vector3d(u, v, 1);
        double nearest = std::numeric_limits<double>::infinity();
        std::uint16_t axis = 0;
        for (std::uint16_t k = 0; k < 3; ++k)
        {
          if (d[k] == 0) continue;
          const double t = ((d[k] > 0 ? high[k] : low[k]) - T_world_optical_.t[k]) / d[k];
          if (t < nearest) nearest = t, axis = k;
        }
        out_.depth[index(u, v)] = static_cast<float>(nearest);
        part_[index(u, v)] = axis;
      }
  }

  void castObject(int object)
  {
    const SceneObject& o = scene_.objects[static_cast<std::size_t>(object)];
    seen_.emplace_back();
    if (!o.standsAt(time_))
    {
      out_.outlinePixels.push_back(0);
      out_.outline.emplace_back();
      return;
    }
    const mrpt::poses::CPose3D T_world_obj = o.poseAt(time_);
    for (const auto& part : o.parts)
    {
      const Transform T_world_prim(T_world_obj + part.T_obj_prim);
      SeenPrimitive seen{
          &part,
          T_world_prim.inverted(T_world_optical_.t),
          T_world_prim.R.transpose() * T_world_optical_.R * rays_,
          {}};
      seen.rect = boundsOf(seen, out_.camera);
      seen_.back().push_back(seen);
    }
    for (std::size_t part = 0; part < o.parts.size(); ++part)
      castPart(object, static_cast<std::uint16_t>(part));
    out_.outlinePixels.push_back(coveredInside_ + coveredOutside(seen_.back()));
    out_.outline.push_back(outlineBox(o, T_world_obj - T_world_camera_, out_.camera));
    coveredInside_ = 0;
  }

  void castPart(int object, std::uint16_t part)
  {
    const SeenPrimitive& seen = seen_.back()[part];
    const PixelRect rect = seen.rect.clipped({0, 0, width_, height_});
    for (int v = rect.v1; v < rect.v2; ++v)
      for (int u = rect.u1; u < rect.u2; ++u)
      {
        const auto t = intersect(*seen.primitive, seen.o, seen.direction(u, v));
        if (!t) continue;
        const std::size_t i = index(u, v);
        if (touchedBy_[i] != object) ++coveredInside_, touchedBy_[i] = object;
        if (*t >= static_cast<double>(out_.depth[i])) continue;
        out_.depth[i] = static_cast<float>(*t);
        out_.object[i] = object;
        part_[i] = part;
      }
  }

  /** Number of pixels that an object covers outside the image, by a coarse grid of rays. */
  double coveredOutside(const std::vector<SeenPrimitive>& parts) const
  {
    const PixelRect image{0, 0, width_, height_};
    PixelRect all{1 << 20, 1 << 20, -(1 << 20), -(1 << 20)};
    for (const auto& seen : parts)
    {
      if (seen.rect.u1 >= seen.rect.u2) continue;
      all = {
          std::min(all.u1, seen.rect.u1), std::min(all.v1, seen.rect.v1),
          std::max(all.u2, seen.rect.u2), std::max(all.v2, seen.rect.v2)};
    }
    double count = 0;
    for (int v = all.v1; v < all.v2; v += kOutsideStep)
      for (int u = all.u1; u < all.u2; u += kOutsideStep)
      {
        if (image.contains(u, v)) continue;
        const bool hit = std::any_of(
            parts.begin(), parts.end(),
            [&](const SeenPrimitive& seen) {
              return seen.rect.contains(u, v) &&
                     intersect(*seen.primitive, seen.o, seen.direction(u, v));
            });
        if (hit) count += kOutsideStep * kOutsideStep;
      }
    return count;
  }

  /** The point that the ray of a pixel met. */
  struct Surface
  {
    Vector3d p;       // in the frame of the texture
    Vector3d normal;  // in the world, towards the camera's side
    const Material* material;
  };

  Surface surfaceAt(int u, int v) const
  {
    const std::size_t i = index(u, v);
    const double depth = static_cast<double>(out_.depth[i]);
    const std::uint16_t part = part_[i];
    if (out_.object[i] == RenderedFrame::kRoom)
    {
      const Vector3d d = T_world_optical_.R * rays_ * Vector3d(u, v, 1);
      Vector3d normal = Vector3d::Zero();
      normal[part] = d[part] > 0 ? -1 : 1;
      const Room& room = scene_.room;
      const std::size_t vertical = normal.z() > 0 ? room.floor : room.ceiling;
      const std::size_t material = part == 2 ? vertical : room.walls;
      return {T_world_optical_.t + depth * d, normal, &scene_.materials[material]};
    }
    const auto object = static_cast<std::size_t>(out_.object[i]);
    const SeenPrimitive& seen = seen_[object][part];
    const Vector3d p = seen.o + depth * seen.direction(u, v);
    // D = R_prim_optical * rays_, so this is R_world_prim:
    const Matrix3d R_world_prim = T_world_optical_.R * rays_ * seen.D.inverse();
    return {
        p, R_world_prim * surfaceNormal(*seen.primitive, p),
        &scene_.materials[seen.primitive->material]};
  }

  void shade()
  {
    const Vector3d light = Vector3d(0.35, 0.25, 0.9).normalized();
    for (int v = 0; v < height_; ++v)
      for (int u = 0; u < width_; ++u)
      {
        const std::size_t i = index(u, v);
        const Surface s = surfaceAt(u, v);
        const Vector3d ray = (T_world_optical_.R * rays_ * Vector3d(u, v, 1)).normalized();
        const double facing = std::abs(ray.dot(s.normal));
        const double lit = 0.5 + 0.35 * std::max(0.0, light.dot(s.normal)) + 0.15 * facing;
        const double brightness = lit * textureBrightness(*s.material, s.p);
        for (int c = 0; c < 3; ++c)
          out_.rgb[3 * i + static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(
              std::lround(std::clamp(brightness * s.material->color[c], 0.0, 255.0)));
        out_.cosIncidence[i] = static_cast<float>(facing);
        out_.returnsDepth[i] = s.material->depth ? 1 : 0;
      }
  }

  const Scene& scene_;
  const double time_;
  const mrpt::poses::CPose3D T_world_camera_;
  const Transform T_world_optical_;
  const Matrix3d rays_;  // (u, v, 1) to the direction with z = 1 in `optical`
  const int width_, height_;
  RenderedFrame out_;
  std::vector<std::uint16_t> part_;               // index of the part; for the room, the axis
  std::vector<std::int32_t> touchedBy_;           // last object that covers the pixel, be it hidden
  std::vector<std::vector<SeenPrimitive>> seen_;  // by object and part
  double coveredInside_ = 0;
};

}  // namespace

RenderedFrame RayCaster::render(const mrpt::poses::CPose3D& T_world_camera, double time) const
{
  return FrameRenderer(scene_, camera_, T_world_camera, time).render();
}

}  // namespace quadmap::simulator
