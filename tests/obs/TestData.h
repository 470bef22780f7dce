#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace quadmap
{
/** A file or folder of the real recordings, which are not part of the project: below
 * $QUADMAP_TEST_DATA, else beside the source tree. Empty when it is not there. */
inline std::string testData(const std::string& name)
{
  const char* fromUser = std::getenv("QUADMAP_TEST_DATA");
  const std::filesystem::path folder =
      fromUser && *fromUser ? fromUser : QUADMAP_SOURCE_DIR "/../shared/data";
  std::error_code ignored;
  return std::filesystem::exists(folder / name, ignored) ? (folder / name).string() : "";
}

}  // namespace quadmap
