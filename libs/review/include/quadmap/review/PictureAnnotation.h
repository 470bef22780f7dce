#pragma once

#include <mrpt/img/CImage.h>

#include "quadmap/review/RenderCamera.h"
#include "quadmap/review/SceneContent.h"

namespace quadmap
{
/** Writes on a rendered picture what makes it readable: label and id of each object, moved apart
 * where they would overlap, with "?" for doubtful ones, "phantom" for those that the truth lacks
 * and "missed" for true ones that the map lacks; a legend of the lines; a bar of a round length,
 * which holds at the distance of the camera's target; the axes of the map. \param camera With which
 * the picture was rendered. */
void annotatePicture(
    const SceneContent& content, const RenderCamera& camera, mrpt::img::CImage& picture);

}  // namespace quadmap
