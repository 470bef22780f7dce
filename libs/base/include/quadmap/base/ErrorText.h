#pragma once

#include <exception>
#include <string>

namespace quadmap
{
/** The cause an exception tells, on one line: without MRPT's nested messages and call stacks. */
std::string rootMessage(const std::exception& e);

}  // namespace quadmap
