#include "quadmap/review/SceneRenderer.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <thread>

#include "../obs/FileSizeLimit.h"
#include "../obs/TemporaryFolder.h"
#include "SampleScene.h"
#include "quadmap/obs/LabelColor.h"
#include "quadmap/review/SceneBuilder.h"

using namespace quadmap;
using namespace quadmap::testing;

namespace
{
constexpr PictureSize kSize{320, 200};

/** Pixel of a map point, by the look-at construction of OpenGL's textbooks. */
Eigen::Vector2i pixelOf(
    const RenderCamera& camera, const PictureSize& size, const Eigen::Vector3d& p)
{
  const Eigen::Vector3d toEye(
      std::cos(camera.elevation) * std::cos(camera.azimuth),
      std::cos(camera.elevation) * std::sin(camera.azimuth), std::sin(camera.elevation));
  const Eigen::Vector3d forward = -toEye;
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d up = right.cross(forward);
  const Eigen::Vector3d d = p - (camera.target + camera.distance * toEye);
  const double f = 0.5 * size.height / std::tan(0.5 * camera.verticalFov);  // [px]
  const double x = 0.5 * size.width + f * d.dot(right) / d.dot(forward);
  const double y = 0.5 * size.height - f * d.dot(up) / d.dot(forward);
  return {static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y))};
}

Eigen::Vector3i rgbAt(const mrpt::img::CImage& picture, const Eigen::Vector2i& pixel)
{
  const std::uint8_t* bgr =
      picture.ptr<std::uint8_t>(static_cast<unsigned>(pixel.x()), static_cast<unsigned>(pixel.y()));
  return {bgr[2], bgr[1], bgr[0]};
}

/** Deviations of the channels from their mean, which mixing with grey only scales. */
Eigen::Vector3d hueOf(const Eigen::Vector3i& rgb)
{
  const Eigen::Vector3d v = rgb.cast<double>();
  return v - Eigen::Vector3d::Constant(v.mean());
}

class SceneRendererTest : public ::testing::Test
{
 protected:
  SceneRendererTest() { ::unsetenv("DISPLAY"); }
};
}  // namespace

TEST_F(SceneRendererTest, ObjectsAppearWhereTheyProjectInTheirColours)
{
  SceneContent content = sampleContent();
  content.truth.clear();
  SceneRenderer renderer(kSize);
  for (const RenderCamera& camera :
       {obliqueCamera(content, kSize.aspect()), cameraFromAbove(content, kSize.aspect())})
  {
    const auto scene = SceneBuilder().picture(content, camera, kSize);
    const mrpt::img::CImage picture = renderer.render(*scene, camera);
    ASSERT_EQ(picture.getWidth(), kSize.width);
    ASSERT_EQ(picture.getHeight(), kSize.height);
    for (const ObjectRecord& record : content.objects)
    {
      // The point is below the centre, as the label may cover what is above it.
      const Eigen::Vector3d p =
          record.object.center() - 0.6 * record.object.semiAxes().minCoeff() * camera.axes().col(1);
      const auto seen = hueOf(rgbAt(picture, pixelOf(camera, kSize, p)));
      const auto color = labelColor(record.label);
      const auto expected = hueOf({color.R, color.G, color.B});
      EXPECT_GT(seen.norm(), 20) << record.label << ": something coloured";
      EXPECT_GT(seen.dot(expected) / seen.norm() / expected.norm(), 0.9) << record.label;
    }
    EXPECT_GT(rgbAt(picture, {2, 2}).minCoeff(), 220) << "white background in the corner";
  }
}

TEST_F(SceneRendererTest, OneRendererPerThreadCanLive)
{
  {
    SceneRenderer first(kSize);
    EXPECT_NE(errorOf([] { SceneRenderer second(kSize); }).find("only one"), std::string::npos);
    std::string errorOfThread = "not run";
    std::thread other([&] { errorOfThread = errorOf([] { SceneRenderer third(kSize); }); });
    other.join();
    EXPECT_EQ(errorOfThread, "") << "another thread has its own";
  }
  EXPECT_EQ(errorOf([] { SceneRenderer again(kSize); }), "");
}

TEST_F(SceneRendererTest, RendersAnEmptyMap)
{
  SceneRenderer renderer(kSize);
  const RenderCamera camera = obliqueCamera({}, kSize.aspect());
  const auto picture = renderer.render(*SceneBuilder().picture({}, camera, kSize), camera);
  EXPECT_GT(rgbAt(picture, {160, 100}).minCoeff(), 150);
}

TEST_F(SceneRendererTest, RejectsImpossibleSizes)
{
  for (const PictureSize& size : {
           PictureSize{   0, 100},
           PictureSize{ 100,  15},
           PictureSize{5000, 100}
  })
  {
    const std::string error = errorOf([&] { SceneRenderer renderer(size); });
    EXPECT_NE(error.find("16...4096"), std::string::npos) << error;
  }
}

TEST_F(SceneRendererTest, WritesPicturesCompletelyOrNotAtAll)
{
  const TemporaryFolder folder;
  mrpt::img::CImage picture(20, 10, mrpt::img::CH_RGB);
  picture.filledRectangle(0, 0, 20, 10, mrpt::img::TColor(10, 200, 30));
  writePicture(picture, folder.path("a.png"));
  mrpt::img::CImage read;
  ASSERT_TRUE(read.loadFromFile(folder.path("a.png")));
  EXPECT_EQ(rgbAt(read, {5, 5}), Eigen::Vector3i(10, 200, 30));
  EXPECT_EQ(folder.fileCount(), 1u);
  EXPECT_NE(
      errorOf([&] { writePicture(picture, "/nonexistent/a.png"); }).find("/nonexistent/a.png"),
      std::string::npos);
  EXPECT_FALSE(errorOf([&] { writePicture(picture, folder.path("a.xyz")); }).empty());
  EXPECT_EQ(folder.fileCount(), 1u);
}

TEST_F(SceneRendererTest, AFullDiskIsOneErrorWithoutALineOfTheLibraries)
{
  const TemporaryFolder folder;
  mrpt::img::CImage picture(64, 64, mrpt::img::CH_RGB);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) picture.setPixel(x, y, static_cast<std::size_t>(40503 * x * y));
  for (const std::string& path : {folder.path("a.png"), folder.path("a.jpg")})
  {
    ::testing::internal::CaptureStderr();
    const auto error = [&]
    {
      const FileSizeLimit limit(500);
      return errorOf([&] { writePicture(picture, path); });
    }();
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << path;
    EXPECT_NE(error.find(path + ": cannot be written: "), std::string::npos) << error;
  }
  EXPECT_EQ(folder.fileCount(), 0u);
}
