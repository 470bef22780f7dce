#pragma once

#include <mrpt/img/TColor.h>

#include <string>

namespace quadmap
{
/** The colour a label has in every picture and scene: a function of the text alone, so that
 * pictures of different maps can be compared. Saturated enough to stand out on white. */
mrpt::img::TColor labelColor(const std::string& label, std::uint8_t alpha = 255);

}  // namespace quadmap
