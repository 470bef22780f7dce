#pragma once

#include "quadmap/folders/FrameFolder.h"

namespace quadmap
{
/** The same recording in a right-handed world.
 *
 * A negative fy (ICL-NUIM) says that y points up in the camera, whose axes are then left-handed,
 * and so is the world of its poses: in numbers it is the mirror image of what the images show. With
 * y negated in the camera, its depth camera and the world, the images stay as they are, and points
 * in space are those of the room: doc/mathematics.md, (24.3). */
FolderContent rightHanded(FolderContent content);

}  // namespace quadmap
