#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
class FramePerception;

/** What tells where up is at the first image. */
enum class UpOrigin
{
  Images,    //!< Nothing: the images are held upright
  Surfaces,  //!< What is level and upright in the first images
  Floor      //!< The floor, which they show
};

/** The normal of the plane on which everything in an image stands, in the robot's frame. It is
 * nothing when the image shows none. A wall that fills the image may be mistaken for it. */
std::optional<Eigen::Vector3d> upOfFloor(
    const FramePerception& perception, const mrpt::obs::CObservation3DRangeScan& scan);

/** Up in the robot's frame by what is level and upright in an image, see upOfRoom().
 * \param guess Robot's frame, unit. */
std::optional<Eigen::Vector3d> upOfSurfaces(
    const PerceptionOptions& options,
    const mrpt::obs::CObservation3DRangeScan& scan,
    const Eigen::Vector3d& guess);

/** The up direction of an image's floor, made better by all that is level and upright in the image.
 * \param up_robot Robot's frame, unit. \return The same where these say something else. */
Eigen::Vector3d levelled(
    const PerceptionOptions& options,
    const mrpt::obs::CObservation3DRangeScan& scan,
    const Eigen::Vector3d& up_robot);

/** Mean of the largest set of directions that agree with one of them: doc/mathematics.md, section
 * 15. It is nothing when there are no directions. */
std::optional<Eigen::Vector3d> agreedDirection(const std::vector<Eigen::Vector3d>& directions);

}  // namespace quadmap
