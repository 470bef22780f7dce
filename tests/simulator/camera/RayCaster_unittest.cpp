#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "../SceneFixture.h"

namespace quadmap::simulator
{
namespace
{
/** Depth and object along one ray, found by intersecting all parts of all objects and the six
 * planes of the room. */
struct Nearest
{
  double depth = std::numeric_limits<double>::infinity();
  int object = RenderedFrame::kRoom;
};

Nearest bruteForce(
    const Scene& scene, const mrpt::poses::CPose3D& T_world_camera, const Eigen::Vector3d& ray)
{
  // Camera frame x forward, y left, z up, so this direction has length 1 along the optical axis.
  const Eigen::Vector3d d_camera(ray.z(), -ray.x(), -ray.y());
  const Eigen::Vector3d o = transformed(T_world_camera, Eigen::Vector3d::Zero());
  const Eigen::Vector3d d = transformed(T_world_camera, d_camera) - o;
  Nearest nearest;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
    {
      const double half = 0.5 * scene.room.size[axis];
      const double at = axis == 2 ? half + side * half : side * half;
      const double t = (at - o[axis]) / d[axis];
      if (t > 0) nearest.depth = std::min(nearest.depth, t);
    }
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    for (const auto& part : scene.objects[i].parts)
    {
      const auto T_world_prim = scene.objects[i].T_world_obj + part.T_obj_prim;
      const Eigen::Vector3d p = inverted(T_world_prim, o);
      const auto t = intersect(part, p, inverted(T_world_prim, o + d) - p);
      if (t && *t < nearest.depth) nearest = {*t, static_cast<int>(i)};
    }
  return nearest;
}

TEST(RayCaster, AgreesWithAskingEverySurface)
{
  const Scene scene = homeScene();
  const PinholeCamera camera = smallCamera();
  const mrpt::poses::CPose3D poses[] = {
      {  -2,  0.3, 1.4,    0,  0.4, 0.05},
      { 0.2,  1.9, 1.3, -1.5,  0.3, -0.1},
      { 1.2, -0.9, 0.5,  2.2, -0.2,  0.3},
      {0.25,  0.1, 1.0,  0.7,  1.2,    0}
  };
  for (const auto& pose : poses)
  {
    const RenderedFrame frame = RayCaster(scene, camera).render(pose);
    std::size_t i = 0, onObjects = 0;
    for (unsigned v = 0; v < camera.height; ++v)
      for (unsigned u = 0; u < camera.width; ++u, ++i)
      {
        const Nearest expected = bruteForce(scene, pose, camera.ray(u, v));
        // Single precision: 24 bits of at most 8 m.
        ASSERT_NEAR(expected.depth, static_cast<double>(frame.depth[i]), 1e-6) << u << " " << v;
        onObjects += frame.object[i] >= 0;
        if (expected.object == frame.object[i]) continue;
        // A cup's bottom is in the plane of the table's top: a tie, either answer is right.
        EXPECT_NE(RenderedFrame::kRoom, frame.object[i]);
        EXPECT_NE(RenderedFrame::kRoom, expected.object);
      }
    EXPECT_GT(onObjects, i / 20);
  }
}

TEST(RayCaster, IncidenceIsThatOfTheSurface)
{
  const Scene scene = sceneFromText(kRoomText);
  const PinholeCamera camera = smallCamera();
  const RenderedFrame frame = RayCaster(scene, camera).render(lookingAhead());
  for (const auto& [u, v] : {
           std::pair{ 80U, 60U},
           { 10U, 50U},
           {150U, 70U}
  })
  {
    const std::size_t i = v * camera.width + u;
    EXPECT_NEAR(3.0, static_cast<double>(frame.depth[i]), 1e-6) << "the wall ahead";
    EXPECT_NEAR(1 / camera.ray(u, v).norm(), static_cast<double>(frame.cosIncidence[i]), 1e-6);
  }
}

const std::string kBoxAndScreen =
    "[object behind]\nlabel = chair\nposition = 2 0 1.3\npart1 = box 0 0 0 0.2 1 1 grey\n"
    "[object front]\nlabel = tv\nposition = 1.5 0.3 1.3\npart1 = box 0 0 0 0.2 0.6 2 screen\n";

TEST(RayCaster, OutlinesDoNotCareWhatStandsInFront)
{
  const Scene both = sceneFromText(kRoomText + kBoxAndScreen);
  Scene alone = both;
  alone.objects.pop_back();
  const PinholeCamera camera = smallCamera();
  const RenderedFrame seen = RayCaster(both, camera).render(lookingAhead());
  const RenderedFrame reference = RayCaster(alone, camera).render(lookingAhead());
  const auto visible = std::count(reference.object.begin(), reference.object.end(), 0);
  EXPECT_EQ(static_cast<double>(visible), seen.outlinePixels[0]);
  EXPECT_LT(std::count(seen.object.begin(), seen.object.end(), 0), visible) << "partly hidden";
}

TEST(RayCaster, OutlinesGoOnBeyondTheImage)
{
  const Scene scene = sceneFromText(kRoomText + kBoxAndScreen);
  const PinholeCamera camera = smallCamera();
  const RenderedFrame ahead = RayCaster(scene, camera).render(lookingAhead());
  mrpt::poses::CPose3D aside = lookingAhead();
  aside.setYawPitchRoll(0.55, 0, 0);  // the box is cut by the right border now
  const RenderedFrame cut = RayCaster(scene, camera).render(aside);
  EXPECT_LT(std::count(cut.object.begin(), cut.object.end(), 0), 0.4 * ahead.outlinePixels[0]);
  PinholeCamera wide = camera;  // the same image with a margin of 100 px
  wide.width += 200;
  wide.cx += 100;
  const RenderedFrame uncut = RayCaster(scene, wide).render(aside);
  // The rays outside are 4 px apart: the outline's border is off by about 2 px of its 40 px width.
  EXPECT_NEAR(uncut.outlinePixels[0], cut.outlinePixels[0], 0.06 * uncut.outlinePixels[0]);
}

TEST(RayCaster, MaterialsSayWhereDepthReturns)
{
  const Scene scene = sceneFromText(kRoomText + kBoxAndScreen);
  const RenderedFrame frame = RayCaster(scene, smallCamera()).render(lookingAhead());
  for (std::size_t i = 0; i < frame.object.size(); ++i)
    EXPECT_EQ(frame.object[i] == 1 ? 0 : 1, frame.returnsDepth[i]);
}

TEST(RayCaster, SurfacesLookTheSameFromEverywhere)
{
  // Colour changes with the angle of view by less than the light's share that comes with the
  // camera, 15 %; the pattern itself must stay where it is.
  const Scene scene = homeScene();
  const PinholeCamera camera = smallCamera();
  const mrpt::poses::CPose3D first(-1.9, 1.2, 1.4, -0.4, 0.3, 0);
  const mrpt::poses::CPose3D second(-1.9, 1.3, 1.45, -0.45, 0.32, 0.05);
  const RenderedFrame a = RayCaster(scene, camera).render(first);
  const RenderedFrame b = RayCaster(scene, camera).render(second);
  std::vector<double> differences;
  for (unsigned v = 0; v < camera.height; v += 3)
    for (unsigned u = 0; u < camera.width; u += 3)
    {
      const std::size_t i = v * camera.width + u;
      const Eigen::Vector3d optical = static_cast<double>(a.depth[i]) * camera.ray(u, v);
      const Eigen::Vector3d world = transformed(first, {optical.z(), -optical.x(), -optical.y()});
      const Eigen::Vector3d p = inverted(second, world);
      const Eigen::Vector2d q = camera.project({-p.y(), -p.z(), p.x()});
      const long x = std::lround(q.x()), y = std::lround(q.y());
      if (x < 0 || y < 0 || x >= camera.width || y >= camera.height) continue;
      const auto j = static_cast<std::size_t>(y) * camera.width + static_cast<std::size_t>(x);
      if (std::abs(static_cast<double>(b.depth[j]) - p.x()) > 0.02) continue;  // hidden there
      differences.push_back(std::abs(a.rgb[3 * i] - b.rgb[3 * j]));
    }
  ASSERT_GT(differences.size(), 800U);
  std::sort(differences.begin(), differences.end());
  // Half a pixel of rounding, at 160 px some 5 mm on the floor: a small part of the patterns.
  EXPECT_LT(differences[differences.size() / 2], 4) << "median, of 255";
  EXPECT_GT(momentsOf({a.rgb.begin(), a.rgb.end()}).deviation, 25) << "there is a picture";
}

}  // namespace
}  // namespace quadmap::simulator
