#pragma once

#include <mrpt/core/format.h>

#include <string>

namespace quadmap
{
/** A number for an INI file: MRPT's own writer keeps six decimals only. */
inline std::string optionText(double value) { return mrpt::format("%.10g", value); }

}  // namespace quadmap
