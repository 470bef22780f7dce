#pragma once

#include <mrpt/opengl/CSetOfObjects.h>

#include <vector>

#include "quadmap/obs/ObjectList.h"
#include "quadmap/review/RenderCamera.h"

namespace quadmap
{
/** The names and ids of the objects, above them and turned towards the eye. \param height Height of
 * the letters [m]. */
mrpt::opengl::CSetOfObjects::Ptr standingLabels(
    const std::vector<ObjectRecord>& objects, const RenderCamera& camera, double height);

}  // namespace quadmap
