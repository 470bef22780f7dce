#pragma once

#include <mrpt/config/CConfigFileMemory.h>

#include <map>
#include <string>
#include <vector>

namespace quadmap::simulator
{
/** The sections of a scene file and of the files that it includes, as if they were one file.
 * Included files are looked for beside the file that names them, then among the installed scenes.
 * When several files have a key, the file nearest to the scene's own counts. */
class SceneConfig
{
 public:
  /** \exception std::runtime_error For a file that cannot be read. The message names it. */
  explicit SceneConfig(const std::string& path);

  const mrpt::config::CConfigFileBase& config() const { return config_; }
  const std::vector<std::string>& sections() const { return sections_; }

  /** The file that a message is about which begins with "[SECTION] KEY" or with "[SECTION]". */
  std::string fileOf(const std::string& message) const;

 private:
  void add(const std::string& path);

  mrpt::config::CConfigFileMemory config_;
  std::vector<std::string> sections_;
  std::map<std::string, std::string> fileOf_;  // keys are "[SECTION]" and "[SECTION] KEY"
  std::vector<std::string> files_;             // those read so far; the first is the scene's own
};

}  // namespace quadmap::simulator
