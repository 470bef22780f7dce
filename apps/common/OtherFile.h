#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "CommandLine.h"

namespace quadmap::cli
{
/** Whether two paths lead to one file, which need not exist. */
inline bool isOneFile(const std::filesystem::path& one, const std::filesystem::path& other)
{
  namespace fs = std::filesystem;
  std::error_code ignored;  // of what cannot be followed, which fails when it is written
  if (fs::equivalent(one, other, ignored)) return true;
  return fs::weakly_canonical(fs::absolute(one, ignored), ignored) ==
         fs::weakly_canonical(fs::absolute(other, ignored), ignored);
}

/** A recording is read and stays: it cannot be made again.
 * \exception UsageError If the output is the same file as the input. */
inline void requireOtherFile(const std::string& output, const std::string& input)
{
  std::error_code ignored;  // of a file that does not exist, which is another one
  if (std::filesystem::equivalent(output, input, ignored))
    throw UsageError("-o: " + output + " is the recording itself, which stays as it is");
}

}  // namespace quadmap::cli
