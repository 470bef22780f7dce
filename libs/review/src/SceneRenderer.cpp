#include "quadmap/review/SceneRenderer.h"

#include <mrpt/core/format.h>
#include <mrpt/opengl/CFBORender.h>

#include <cstdint>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <vector>

#include "quadmap/base/OutputFile.h"
#include "quadmap/base/OutputSet.h"

namespace quadmap
{
namespace
{
thread_local bool rendererIsAlive = false;

std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

SceneRenderer::SceneRenderer(const PictureSize& size) : size_(size)
{
  if (!size.isValid())
    throw std::invalid_argument(mrpt::format(
        "picture size %ux%u: sides must be %u...%u pixels", size.width, size.height,
        PictureSize::kSmallestSide, PictureSize::kLargestSide));
  if (rendererIsAlive)
    throw std::runtime_error("only one SceneRenderer can live in a thread at a time");
  try
  {
    constexpr unsigned k = PictureSize::kOversampling;
    mrpt::opengl::CFBORender::Parameters parameters(k * size.width, k * size.height);
    renderer_ = std::make_unique<mrpt::opengl::CFBORender>(parameters);
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error(
        "pictures cannot be rendered: OpenGL without a display (EGL) does not work here; on Debian "
        "install libegl1 and libgl1-mesa-dri (" +
        firstLine(e.what()) + ")");
  }
  rendererIsAlive = true;
}

SceneRenderer::~SceneRenderer()
{
  renderer_.reset();
  rendererIsAlive = false;
}

mrpt::img::CImage SceneRenderer::render(
    mrpt::opengl::COpenGLScene& scene, const RenderCamera& camera)
{
  const auto viewport = scene.getViewport();
  camera.applyTo(viewport->getCamera());
  camera.applyTo(renderer_->getCamera(scene));
  constexpr float kNear = 0.02F, kFar = 4.0F;  // / distance to the target
  const auto distance = static_cast<float>(camera.distance);
  viewport->setViewportClipDistances(kNear * distance, kFar * distance);

  mrpt::img::CImage large, picture;
  renderer_->render_RGB(scene, large);
  large.scaleImage(picture, size_.width, size_.height, mrpt::img::IMG_INTERP_AREA);
  return picture;
}

void writePicture(const mrpt::img::CImage& picture, const std::string& path)
{
  const std::vector<int> smallest = {cv::IMWRITE_PNG_COMPRESSION, 9};  // MRPT has no such option
  // In memory first, as libpng and libjpeg print why a file cannot be written, and do not tell us.
  std::vector<std::uint8_t> bytes;
  bool encoded = false;
  try
  {
    const std::string extension = std::filesystem::path(path).extension().string();
    encoded = cv::imencode(extension, picture.asCvMatRef(), bytes, smallest);
  }
  catch (const cv::Exception&)  // for an extension that OpenCV does not know
  {
  }
  if (!encoded) throw std::runtime_error(pathAfterCommit(path) + ": the picture cannot be written");
  writeTextFile(path, {bytes.begin(), bytes.end()});
}

}  // namespace quadmap
