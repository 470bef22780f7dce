#pragma once

#include <mrpt/opengl/CSetOfObjects.h>

#include <vector>

#include "quadmap/obs/ObjectList.h"
#include "quadmap/review/RenderCamera.h"

namespace quadmap
{
/** The names of the objects, above them and turned towards the eye. \param height Height of the
 * letters [m]. */
mrpt::opengl::CSetOfObjects::Ptr standingLabels(
    const std::vector<ObjectRecord>& objects, const RenderCamera& camera, double height);

/** How the labels of a picture look. */
struct PictureLabels
{
  double aspect;  //!< Width of the picture / its height
  double height;  //!< Height of the letters / height of the picture
};

/** The names of the objects for one picture. They have one size, are in front of everything, and
 * are moved apart where they would overlap. */
mrpt::opengl::CSetOfObjects::Ptr pictureLabels(
    const std::vector<ObjectRecord>& objects,
    const RenderCamera& camera,
    const PictureLabels& style);

}  // namespace quadmap
