#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/opengl/COpenGLScene.h>

#include <memory>
#include <string>

#include "quadmap/review/RenderCamera.h"

namespace mrpt::opengl
{
class CFBORender;
}

namespace quadmap
{
/** Renders scenes without a display, by EGL (Mesa's software renderer suffices).
 *
 * OpenGL allows one live renderer per thread. A scene can be rendered by one renderer only, and
 * must be built again for another. */
class SceneRenderer
{
 public:
  /** \param size Its sides are 16 to 4096 pixels.
   *  \exception std::invalid_argument For a size out of bounds.
   *  \exception std::runtime_error If there is no OpenGL, or another renderer lives in this
   *  thread. */
  explicit SceneRenderer(const PictureSize& size = {});
  ~SceneRenderer();
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;

  const PictureSize& size() const { return size_; }

  mrpt::img::CImage render(mrpt::opengl::COpenGLScene& scene, const RenderCamera& camera);

 private:
  PictureSize size_;
  std::unique_ptr<mrpt::opengl::CFBORender> renderer_;
};

/** Writes a picture in the format of the name's extension. The file appears complete or not at all.
 * \exception std::runtime_error If it cannot be written. */
void writePicture(const mrpt::img::CImage& picture, const std::string& path);

}  // namespace quadmap
