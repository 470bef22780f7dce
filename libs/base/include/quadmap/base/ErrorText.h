#pragma once

#include <exception>
#include <string>

namespace quadmap
{
/** A text as one line that a terminal shows as it is: control bytes and what is not UTF-8 become
 * '?', line breaks a space, and of a long text the middle is left out. */
std::string oneLine(const std::string& text);

/** The cause an exception tells, as oneLine(): without MRPT's nested messages and call stacks,
 * OpenCV's places in its source, and the words "filesystem error". */
std::string rootMessage(const std::exception& e);

}  // namespace quadmap
