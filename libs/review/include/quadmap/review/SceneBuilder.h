#pragma once

#include <mrpt/opengl/COpenGLScene.h>

#include <string>

#include "quadmap/review/SceneContent.h"
#include "quadmap/review/ViewPoint.h"

namespace quadmap
{
/** How a scene looks. */
struct SceneOptions
{
  double labelHeight = 0.12;          //!< Letters of a scene for a viewer [m], > 0
  double pictureLabelHeight = 0.022;  //!< Letters of a picture, as a part of its height, > 0
  double lineRadius = 0.008;          //!< Half the width of a scene's lines [m], > 0
  double pictureLineRadius = 0.0018;  //!< The same in pictures, as a part of their height, > 0
  double cloudMargin = 1.0;           //!< The cloud is drawn this far around the rest [m], >= 0
  double cloudPaleness = 0.45;        //!< Share of white in the cloud's colours, in [0, 1]
  unsigned insideThinning = 4;        //!< One in so many of the cloud's points on objects, > 0
  double cameraLength = 0.18;         //!< Of the pyramids [m], > 0
  unsigned shownCameras = 12;         //!< Pyramids, spread evenly over the keyframes
};

/** Makes 3D scenes out of the parts of a map. The objects of a scene are grouped under the names
 * "floor", "cloud", "cloud of the objects", "objects", "labels", "truth", "trajectory", "odometry"
 * and "cameras". */
class SceneBuilder
{
 public:
  explicit SceneBuilder(const SceneOptions& options = {}) : options_(options) {}

  /** For a viewer in which one can walk around (SceneViewer3D). */
  mrpt::opengl::COpenGLScene::Ptr scene(const SceneContent& content) const;

  /** For one picture: only the cloud's points that face the eye are in it, so that near walls
   *  and the ceiling do not hide the room; labels face the eye, stand in front of everything and
   *  do not overlap. */
  mrpt::opengl::COpenGLScene::Ptr picture(
      const SceneContent& content, const ViewPoint& view, const PictureSize& size = {}) const;

 private:
  SceneOptions options_;
};

/** From above at an angle, from the side that hides least. */
ViewPoint obliqueView(const SceneContent& content, double aspect);

/** Straight from above, the longer side of the map along the picture's longer side. */
ViewPoint topView(const SceneContent& content, double aspect);

/** Writes a .3Dscene file, complete or not at all. \exception std::runtime_error */
void writeScene(const mrpt::opengl::COpenGLScene& scene, const std::string& path);

}  // namespace quadmap
