#include "quadmap/sensors/simulator/RayCaster.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "quadmap/sensors/simulator/Silhouette.h"
#include "quadmap/sensors/simulator/SurfaceTexture.h"

namespace quadmap::simulator
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kNear = 0.01;   // corners nearer than this to the image plane: no tight bounds [m]
constexpr int kOutsideStep = 4;  // outside the image every 4th ray of every 4th row is enough

/** A pose as plain numbers, quick to apply. */
struct Transform
{
  Matrix3d R;
  Vector3d t;

  explicit Transform(const mrpt::poses::CPose3D& pose) :
      R(pose.getRotationMatrix().asEigen()), t(pose.x(), pose.y(), pose.z())
  {
  }
  Vector3d inverted(const Vector3d& p) const { return R.transpose() * (p - t); }
};

/** Pixels [u1, u2) x [v1, v2); may lie outside the image. */
struct PixelRect
{
  int u1 = 0, v1 = 0, u2 = 0, v2 = 0;

  PixelRect clipped(const PixelRect& to) const
  {
    PixelRect r{std::max(u1, to.u1), std::max(v1, to.v1), std::min(u2, to.u2), std::min(v2, to.v2)};
    r.u2 = std::max(r.u1, r.u2);
    r.v2 = std::max(r.v1, r.v2);
    return r;
  }
  bool contains(int u, int v) const { return u >= u1 && u < u2 && v >= v1 && v < v2; }
};

/** A primitive as one camera sees it: rays start at `o` with direction D * (u, v, 1) in `prim`. As
 * the optical z of that direction is 1, the ray parameter is the depth. */
struct View
{
  const Primitive* primitive;
  Vector3d o;
  Matrix3d D;
  PixelRect rect;  // encloses the projection, not clipped to the image

  Vector3d direction(int u, int v) const { return D * Vector3d(u, v, 1); }
};

Matrix3d inverseOf(const PinholeCamera& camera)
{
  Matrix3d rays;
  rays << 1 / camera.fx, 0, -camera.cx / camera.fx,  //
      0, 1 / camera.fy, -camera.cy / camera.fy,      //
      0, 0, 1;
  return rays;
}

/** The image with a margin of one image size all around. */
PixelRect surroundings(const PinholeCamera& camera)
{
  const int w = static_cast<int>(camera.width), h = static_cast<int>(camera.height);
  return {-w, -h, 2 * w, 2 * h};
}

PixelRect boundsOf(const View& view, const PinholeCamera& camera)
{
  const Matrix3d P = view.D.inverse();  // `prim` directions to (u z, v z, z)
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  int behind = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vector3d sign((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
    const Vector3d p = P * (sign.cwiseProduct(view.primitive->halfSize) - view.o);
    if (p.z() < kNear)
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

/** Renders one frame; the buffers are those of the result. */
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

  /** The camera is inside the room: the nearest of the three planes each ray runs towards. */
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
    views_.emplace_back();
    if (!o.standsAt(time_))
    {
      out_.outlinePixels.push_back(0);
      out_.outline.emplace_back();
      return;
    }
    for (const auto& part : o.parts)
    {
      const Transform T_world_prim(o.T_world_obj + part.T_obj_prim);
      View view{
          &part,
          T_world_prim.inverted(T_world_optical_.t),
          T_world_prim.R.transpose() * T_world_optical_.R * rays_,
          {}};
      view.rect = boundsOf(view, out_.camera);
      views_.back().push_back(view);
    }
    for (std::size_t part = 0; part < o.parts.size(); ++part)
      castPart(object, static_cast<std::uint16_t>(part));
    out_.outlinePixels.push_back(coveredInside_ + coveredOutside(views_.back()));
    out_.outline.push_back(outlineBox(o, T_world_camera_, out_.camera));
    coveredInside_ = 0;
  }

  void castPart(int object, std::uint16_t part)
  {
    const View& view = views_.back()[part];
    const PixelRect rect = view.rect.clipped({0, 0, width_, height_});
    for (int v = rect.v1; v < rect.v2; ++v)
      for (int u = rect.u1; u < rect.u2; ++u)
      {
        const auto t = intersect(*view.primitive, view.o, view.direction(u, v));
        if (!t) continue;
        const std::size_t i = index(u, v);
        if (touchedBy_[i] != object) ++coveredInside_, touchedBy_[i] = object;
        if (*t >= static_cast<double>(out_.depth[i])) continue;
        out_.depth[i] = static_cast<float>(*t);
        out_.object[i] = object;
        part_[i] = part;
      }
  }

  /** Pixels that the parts of an object cover outside the image, from a coarse grid of rays. */
  double coveredOutside(const std::vector<View>& views) const
  {
    const PixelRect image{0, 0, width_, height_};
    PixelRect all{1 << 20, 1 << 20, -(1 << 20), -(1 << 20)};
    for (const auto& view : views)
    {
      if (view.rect.u1 >= view.rect.u2) continue;
      all = {
          std::min(all.u1, view.rect.u1), std::min(all.v1, view.rect.v1),
          std::max(all.u2, view.rect.u2), std::max(all.v2, view.rect.v2)};
    }
    double count = 0;
    for (int v = all.v1; v < all.v2; v += kOutsideStep)
      for (int u = all.u1; u < all.u2; u += kOutsideStep)
      {
        if (image.contains(u, v)) continue;
        const bool hit = std::any_of(
            views.begin(), views.end(),
            [&](const View& view) {
              return view.rect.contains(u, v) &&
                     intersect(*view.primitive, view.o, view.direction(u, v));
            });
        if (hit) count += kOutsideStep * kOutsideStep;
      }
    return count;
  }

  /** What the ray of a pixel met. */
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
    const View& view = views_[object][part];
    const Vector3d p = view.o + depth * view.direction(u, v);
    // D = R_prim_optical * rays_, so this is R_world_prim:
    const Matrix3d R_world_prim = T_world_optical_.R * rays_ * view.D.inverse();
    return {
        p, R_world_prim * surfaceNormal(*view.primitive, p),
        &scene_.materials[view.primitive->material]};
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
  std::vector<std::uint16_t> part_;       // which part of the object; of the room, the axis
  std::vector<std::int32_t> touchedBy_;   // last object that covers the pixel, hidden or not
  std::vector<std::vector<View>> views_;  // by object and part
  double coveredInside_ = 0;
};

}  // namespace

RenderedFrame RayCaster::render(const mrpt::poses::CPose3D& T_world_camera, double time) const
{
  return FrameRenderer(scene_, camera_, T_world_camera, time).render();
}

}  // namespace quadmap::simulator
