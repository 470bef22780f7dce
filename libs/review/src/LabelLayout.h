#pragma once

#include <mrpt/opengl/CSetOfObjects.h>

#include <Eigen/Dense>
#include <vector>

#include "quadmap/obs/ObjectList.h"
#include "quadmap/review/RenderCamera.h"

namespace quadmap
{
/** The names and ids of the objects, above them and turned towards the eye. \param height Height of
 * the letters [m]. */
mrpt::opengl::CSetOfObjects::Ptr standingLabels(
    const std::vector<ObjectRecord>& objects, const RenderCamera& camera, double height);

/** The point above an object's centre at the height of its highest corner. */
Eigen::Vector3d topOf(const ObjectRecord& record);

}  // namespace quadmap
