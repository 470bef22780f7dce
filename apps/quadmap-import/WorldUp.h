#pragma once

#include <string>

#include "quadmap/folders/FrameFolder.h"

namespace quadmap
{
/** Turns the world of a recording so that up is +z: as its camera says where up is, else by the
 * floor that its images show, else by horizontal and vertical surfaces in them, else not at all.
 * \return Where up is and how that was found, for the user. */
std::string turnUpright(FrameFolder& folder);

}  // namespace quadmap
