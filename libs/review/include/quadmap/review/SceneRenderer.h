#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/opengl/COpenGLScene.h>

#include <memory>
#include <string>

#include "quadmap/review/ViewPoint.h"

namespace mrpt::opengl
{
class CFBORender;
}

namespace quadmap
{
/** Renders scenes without a display (EGL; Mesa's software renderer suffices).
 *
 * OpenGL allows one live renderer per thread, and a scene can be rendered by one renderer only:
 * build it again for another. */
class SceneRenderer
{
 public:
  /** Sides of 16...4096 pixels.
   *  \exception std::invalid_argument For a size out of bounds.
   *  \exception std::runtime_error If there is no OpenGL, or another renderer lives in this
   *  thread. */
  explicit SceneRenderer(const PictureSize& size = {});
  ~SceneRenderer();
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;

  const PictureSize& size() const { return size_; }

  mrpt::img::CImage render(mrpt::opengl::COpenGLScene& scene, const ViewPoint& view);

 private:
  PictureSize size_;
  std::unique_ptr<mrpt::opengl::CFBORender> renderer_;
};

/** Writes a picture (the name's extension chooses the format), complete or not at all.
 * \exception std::runtime_error */
void writePicture(const mrpt::img::CImage& picture, const std::string& path);

}  // namespace quadmap
