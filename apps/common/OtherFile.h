#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "CommandLine.h"

namespace quadmap::cli
{
/** A recording is read and stays: it cannot be made again.
 * \exception UsageError If the output is the same file as the input. */
inline void requireOtherFile(const std::string& output, const std::string& input)
{
  std::error_code ignored;  // of a file that does not exist, which is another one
  if (std::filesystem::equivalent(output, input, ignored))
    throw UsageError("-o: " + output + " is the recording itself, which stays as it is");
}

}  // namespace quadmap::cli
