#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace quadmap
{
/** A file or folder of the real recordings, which are not part of the project. It is looked for
 * below $QUADMAP_TEST_DATA or, without this variable, beside the source tree. It is empty when it
 * does not exist. */
inline std::string testData(const std::string& name)
{
  const char* fromUser = std::getenv("QUADMAP_TEST_DATA");
  const std::filesystem::path folder =
      fromUser && *fromUser ? fromUser : QUADMAP_SOURCE_DIR "/../shared/data";
  std::error_code ignored;
  return std::filesystem::exists(folder / name, ignored) ? (folder / name).string() : "";
}

}  // namespace quadmap
