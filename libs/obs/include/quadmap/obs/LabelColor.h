#pragma once

#include <mrpt/img/TColor.h>

#include <string>

namespace quadmap
{
/** The colour of a label in every picture and scene. It only depends on the text, so that pictures
 * of different maps can be compared. It is saturated enough to stand out on white. */
mrpt::img::TColor labelColor(const std::string& label, std::uint8_t alpha = 255);

}  // namespace quadmap
