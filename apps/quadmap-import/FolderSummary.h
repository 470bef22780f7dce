#pragma once

#include <ostream>
#include <string>

#include "quadmap/folders/FolderCheck.h"

namespace quadmap
{
/** Writes what is in a recording: frames, how they were paired, camera, poses, boxes.
 * \param up See turnUpright(). */
void writeSummary(const FrameFolder& folder, const std::string& up, std::ostream& out);

/** Writes the problems of a recording by kind, with some examples of each. */
void writeProblems(const FolderProblems& problems, std::ostream& out);

}  // namespace quadmap
