#pragma once

#include <mrpt/config/CConfigFileMemory.h>

#include <map>
#include <string>
#include <vector>

namespace quadmap::simulator
{
/** The sections of a scene file and of the files it includes, as if they stood in one. Included
 * files are looked for beside the file that names them, then among the installed scenes. A key
 * that several files have counts in the one nearest to the top. */
class SceneConfig
{
 public:
  /** \exception std::runtime_error For files that cannot be read; names them. */
  explicit SceneConfig(const std::string& path);

  const mrpt::config::CConfigFileBase& config() const { return config_; }
  const std::vector<std::string>& sections() const { return sections_; }

  /** Which file a message that begins with "[SECTION] KEY" or with "[SECTION]" is about. */
  std::string fileOf(const std::string& message) const;

 private:
  void add(const std::string& path);

  mrpt::config::CConfigFileMemory config_;
  std::vector<std::string> sections_;
  std::map<std::string, std::string> fileOf_;  // by "[SECTION]" and "[SECTION] KEY"
  std::vector<std::string> files_;             // those read so far; the first is the scene's own
};

}  // namespace quadmap::simulator
