#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "../obs/TemporaryFolder.h"

namespace quadmap
{
/** The files of a folder with what is in them, by name. */
inline std::map<std::string, std::string> contentsOf(const std::filesystem::path& folder)
{
  std::map<std::string, std::string> contents;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file())
      contents[entry.path().filename().string()] = readFile(entry.path().string());
  return contents;
}

}  // namespace quadmap
