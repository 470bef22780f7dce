#include "quadmap/review/PictureAnnotation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "SampleScene.h"
#include "quadmap/obs/LabelColor.h"
#include "quadmap/review/SceneBuilder.h"

using namespace quadmap;
using namespace quadmap::testing;

namespace
{
constexpr unsigned kWidth = 1280, kHeight = 800;
const mrpt::img::TColor kPhantom(200, 20, 30);

mrpt::img::CImage annotated(const SceneContent& content, const RenderCamera& camera)
{
  mrpt::img::CImage picture(kWidth, kHeight, mrpt::img::CH_RGB);
  picture.filledRectangle(0, 0, kWidth, kHeight, mrpt::img::TColor(255, 255, 255));
  annotatePicture(content, camera, picture);
  return picture;
}

/** Number of pixels of about this colour in a rectangle around a place. */
int count(
    const mrpt::img::CImage& picture,
    const mrpt::img::TColor& color,
    const Eigen::Vector2d& middle,
    const Eigen::Vector2d& reach)
{
  constexpr int kAlike = 30;  // in each channel; letters have soft edges
  int found = 0;
  for (unsigned y = 0; y < kHeight; ++y)
    for (unsigned x = 0; x < kWidth; ++x)
    {
      if (std::abs(x - middle.x()) > reach.x() || std::abs(y - middle.y()) > reach.y()) continue;
      const std::uint8_t* bgr = picture.ptr<std::uint8_t>(x, y);
      found += std::abs(bgr[0] - color.B) < kAlike && std::abs(bgr[1] - color.G) < kAlike &&
                       std::abs(bgr[2] - color.R) < kAlike
                   ? 1
                   : 0;
    }
  return found;
}

int countAll(const mrpt::img::CImage& picture, const mrpt::img::TColor& color)
{
  return count(picture, color, {0, 0}, {kWidth, kHeight});
}

Eigen::Vector2d pixelOf(const RenderCamera& camera, const Eigen::Vector3d& p_map)
{
  const Eigen::Vector3d p = camera.axes().transpose() * (p_map - camera.eye());
  const double focal = 0.5 * kHeight / std::tan(0.5 * camera.verticalFov);
  return {0.5 * kWidth - focal * p.x() / p.z(), 0.5 * kHeight + focal * p.y() / p.z()};
}
}  // namespace

TEST(PictureAnnotation, WritesTheNameOfEachObjectAtItsPlaceFromAnywhere)
{
  SceneContent content = sampleContent();
  content.truth.clear();
  for (const RenderCamera& camera : {cameraFromAbove(content, 1.6), obliqueCamera(content, 1.6)})
  {
    const mrpt::img::CImage picture = annotated(content, camera);
    for (const ObjectRecord& record : content.objects)
    {
      Eigen::Vector3d top = record.object.center();
      top.z() += record.object.semiAxes().z();
      EXPECT_GT(count(picture, labelColor(record.label), pixelOf(camera, top), {140, 100}), 60)
          << record.label << ": letters, not an empty plate";
    }
  }
}

TEST(PictureAnnotation, MarksPhantomsAndWhatWasMissed)
{
  SceneContent content = sampleContent();
  content.truth = {recordOf("7", "bed", {0, 1.5, 0.3, 0, 0, 0}, {0.5, 0.9, 0.3})};
  const RenderCamera camera = cameraFromAbove(content, 1.6);
  const int red = countAll(annotated(content, camera), kPhantom);  // an axis, and alike labels
  content.phantoms = {"1"};
  EXPECT_GT(countAll(annotated(content, camera), kPhantom), red + 150);
  const mrpt::img::TColor ink(40, 40, 40);
  const int before = countAll(annotated(content, camera), ink);
  content.missed = {"7"};
  EXPECT_GT(countAll(annotated(content, camera), ink), before + 50);
}

TEST(PictureAnnotation, TiesANameToItsObjectWhenItHadToGiveWay)
{
  SceneContent content = sampleContent();
  content.truth.clear();
  const RenderCamera camera = cameraFromAbove(content, 1.6);
  content.objects.clear();
  const auto add = [&](const char* label, double x, double y)  // [px] right and up of the middle
  {
    const double metresPerPixel =
        2 * std::tan(0.5 * camera.verticalFov) * camera.distance / kHeight;
    const Eigen::Vector3d top =
        camera.target + metresPerPixel * camera.axes() * Eigen::Vector3d(x, y, 0);
    constexpr double kHalf = 0.01;  // [m]
    content.objects.push_back(recordOf(
        std::to_string(content.objects.size()), label, {top.x(), top.y(), top.z() - kHalf, 0, 0, 0},
        {kHalf, kHalf, kHalf}));
  };
  // Plates are 30 px high: those of the two chairs leave no place at the vase.
  add("chair", -30, 33);
  add("chair", 0, -28);
  add("vase", 0, 5);
  EXPECT_GT(count(annotated(content, camera), labelColor("vase"), {640, 385}, {4, 6}), 8)
      << "between its object and the plate above";
}

TEST(PictureAnnotation, DrawsABarOfARoundLength)
{
  SceneContent content = sampleContent();
  const RenderCamera camera = cameraFromAbove(content, 1.6);
  const double pixelsPerMetre =
      kHeight / (2 * std::tan(0.5 * camera.verticalFov) * camera.distance);
  const mrpt::img::CImage picture = annotated(content, camera);
  // The longest dark run of a row in the lower right quarter.
  int longest = 0;
  for (unsigned y = kHeight / 2; y < kHeight; ++y)
    for (unsigned x = kWidth / 2, run = 0; x < kWidth; ++x)
    {
      run = picture.ptr<std::uint8_t>(x, y)[0] < 80 ? run + 1 : 0;
      longest = std::max(longest, static_cast<int>(run));
    }
  EXPECT_NEAR(longest / pixelsPerMetre, 1.0, 0.05) << "1 m, as it says";
}

TEST(PictureAnnotation, MayBeTooSmallForAnything)
{
  mrpt::img::CImage picture(16, 16, mrpt::img::CH_RGB);
  const SceneContent content = sampleContent();
  EXPECT_NO_THROW(annotatePicture(content, obliqueCamera(content, 1), picture));
}

TEST(SceneCameras, LookFromAboveAlikeWithAndWithoutATrajectory)
{
  SceneContent folder;
  folder.objects = {
      recordOf("1", "chair", {-3, 0, 0.4, 0, 0, 0}, {0.3, 0.3, 0.4}),
      recordOf("2", "couch", {3, 0.5, 0.4, 0, 0, 0}, {0.3, 0.9, 0.4})};
  SceneContent file = folder;
  for (int i = 0; i < 20; ++i) folder.trajectory.emplace_back(0, i - 10.0, 1, 0, 0, 0);
  EXPECT_EQ(cameraFromAbove(folder, 1.6).azimuth, cameraFromAbove(file, 1.6).azimuth);
  EXPECT_GT(cameraFromAbove(folder, 1.6).distance, cameraFromAbove(file, 1.6).distance)
      << "all of it is in the picture";
}
