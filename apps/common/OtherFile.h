#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "CommandLine.h"
#include "quadmap/sensors/RawlogNames.h"

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

/** The same for a recording that is made from another: its boxes, which have a file of their own
 * beside it, belong to it. \param output A rawlog.
 * \exception UsageError If a file of the output is one of the input. */
inline void requireOtherRecording(const std::string& output, const std::string& input)
{
  requireOtherFile(output, input);
  namespace fs = std::filesystem;
  std::error_code ignored;  // of a file that does not exist, which is another one
  const std::string boxes = objectsFileOf(output), inputBoxes = objectsFileOf(input);
  if (fs::equivalent(output, inputBoxes, ignored))
    throw UsageError("-o: " + output + " has the boxes of the recording, which stay as they are");
  if (fs::equivalent(boxes, input, ignored))
    throw UsageError(
        "-o: the boxes of " + output + " would replace the recording itself, " + input);
  // A folder may have the name of the rawlog that is made of it.
  if (fs::is_regular_file(input, ignored) && fs::equivalent(boxes, inputBoxes, ignored))
    throw UsageError(
        "-o: the boxes of " + output + " would replace those of the recording, " + inputBoxes);
}

}  // namespace quadmap::cli
