#pragma once

#include <mrpt/opengl/CSetOfObjects.h>

#include <vector>

#include "quadmap/obs/ObjectList.h"
#include "quadmap/review/ViewPoint.h"

namespace quadmap
{
/** The names of the objects above them, turned towards the eye, in letters of `height` [m]. */
mrpt::opengl::CSetOfObjects::Ptr standingLabels(
    const std::vector<ObjectRecord>& objects, const ViewPoint& view, double height);

struct PictureLabels
{
  double aspect;  //!< Width of the picture / its height
  double height;  //!< Of the letters, as a part of the picture's height
};

/** The names of the objects for one picture: all of one size, in front of everything, moved apart
 * where they would overlap (a line then leads to the object). */
mrpt::opengl::CSetOfObjects::Ptr pictureLabels(
    const std::vector<ObjectRecord>& objects, const ViewPoint& view, const PictureLabels& style);

}  // namespace quadmap
