#pragma once

#include <mrpt/opengl/COpenGLScene.h>

#include <string>

#include "quadmap/review/RenderCamera.h"
#include "quadmap/review/SceneContent.h"

namespace quadmap
{
/** How a scene looks. */
struct SceneOptions
{
  double labelHeight = 0.12;          //!< Height of letters for a viewer [m], > 0
  double lineRadius = 0.008;          //!< Half the width of a scene's lines [m], > 0
  double pictureLineRadius = 0.0018;  //!< The same / height of the picture, > 0
  double cloudMargin = 1.0;           //!< Margin of the cloud around all else [m], >= 0
  double cloudPaleness = 0.45;        //!< Share of white in the cloud's colours, in [0, 1]
  unsigned insideThinning = 4;        //!< One in so many points on objects is drawn, > 0
  double cameraLength = 0.18;         //!< Length of the cameras' pyramids [m], > 0
  unsigned shownCameras = 12;         //!< Number of pyramids, spread evenly over keyframes
};

/** Makes 3D scenes from the parts of a map. The things in a scene are grouped under the names
 * "floor", "cloud", "cloud of the objects", "objects", "labels", "truth", "trajectory", "odometry"
 * and "cameras". */
class SceneBuilder
{
 public:
  explicit SceneBuilder(const SceneOptions& options = {}) : options_(options) {}

  /** A scene for a viewer in which one can walk around (SceneViewer3D). */
  mrpt::opengl::COpenGLScene::Ptr scene(const SceneContent& content) const;

  /** A scene for one picture. It has only those points of the cloud that face the eye, so that near
   *  walls and the ceiling do not hide the room. Labels are written on the picture
   * (annotatePicture). */
  mrpt::opengl::COpenGLScene::Ptr picture(
      const SceneContent& content, const RenderCamera& camera, const PictureSize& size = {}) const;

 private:
  SceneOptions options_;
};

/** A camera that looks down at an angle, from the side from which least of the objects and of the
 * cloud is hidden. */
RenderCamera obliqueCamera(const SceneContent& content, double aspect);

/** A camera that looks straight down, with the longer side of the map along that of the picture;
 * where there are objects, they alone say which that is, so that a map is seen alike with its
 * trajectory and without. */
RenderCamera cameraFromAbove(const SceneContent& content, double aspect);

/** Writes a .3Dscene file. It appears complete or not at all.
 * \exception std::runtime_error If it cannot be written. */
void writeScene(const mrpt::opengl::COpenGLScene& scene, const std::string& path);

}  // namespace quadmap
