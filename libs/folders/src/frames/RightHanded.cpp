#include "frames/RightHanded.h"

#include <Eigen/Dense>
#include <stdexcept>

#include "frames/FolderReader.h"
#include "quadmap/geometry/PoseReflection.h"

namespace quadmap
{
namespace
{
const Eigen::Vector3d kReflection(1, -1, 1);  // the diagonal of D in (24.3)

/** A pose of left-handed axes in left-handed axes, when y is negated in both: doc/mathematics.md,
 * (24.3). */
mrpt::poses::CPose3D rightHanded(const mrpt::poses::CPose3D& pose)
{
  return reflected(pose, kReflection, kReflection);
}

void makeRightHanded(mrpt::img::TCamera& camera)
{
  camera.setIntrinsicParamsFromValues(camera.fx(), -camera.fy(), camera.cx(), camera.cy());
  camera.dist[2] *= -1;  // p1 of (24.2), whose terms have an odd power of y in x, an even one in y
}
}  // namespace

FolderContent rightHanded(FolderContent content)
{
  FolderCamera& camera = content.camera;
  const bool isLeftHanded = camera.color.fy() < 0;
  if (camera.depth && (camera.depth->camera.fy() < 0) != isLeftHanded)
    throw std::runtime_error(
        placeOfCamera(content) +
        ": fy of colour and of depth must have the same sign, as a world is left-handed "
        "for both or for neither");
  if (!isLeftHanded) return content;
  makeRightHanded(camera.color);
  if (camera.depth)
  {
    makeRightHanded(camera.depth->camera);
    camera.depth->T_color_depth = rightHanded(camera.depth->T_color_depth);
  }
  if (camera.worldUp) camera.worldUp = kReflection.cwiseProduct(*camera.worldUp);
  for (auto& frame : content.frames)
    if (frame.T_world_optical) frame.T_world_optical = rightHanded(*frame.T_world_optical);
  content.notes.push_back(
      content.folder + ": fy of " + camera.origin +
      " is negative: the world of the recording is left-handed, and y is negated in it");
  return content;
}

}  // namespace quadmap
