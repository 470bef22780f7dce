#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "CommandLine.h"
#include "ResultFiles.h"

namespace quadmap::cli
{
/** The files that a program reads, which no output of it may replace, whatever name or link leads
 * to them. */
class KeptFiles
{
 public:
  /** Keeps a file, or the files of a folder that quadmap-slam wrote. A file in such a folder stands
   * for the folder. \param but The name of a file of the folder that may be replaced; may be "". */
  void add(const std::filesystem::path& input, const std::string& but = {})
  {
    namespace fs = std::filesystem;
    std::error_code ignored;
    const bool isFolder = fs::is_directory(input, ignored);
    if (!isFolder) files_.push_back(input);
    const fs::path folder = isFolder ? input : input.parent_path();
    if (!isFolder && !fs::exists(folder / "report.json", ignored)) return;
    for (const std::string& name : resultFiles())
      if (name != but) files_.push_back(folder / name);
  }

  /** \param option That names the output, as it is typed.
   *  \exception UsageError If the output is one of them. */
  void requireNone(const std::string& option, const std::string& output) const
  {
    const auto isOutput = [&](const std::filesystem::path& file)
    {
      std::error_code ignored;  // of a file that does not exist, which is another one
      return std::filesystem::equivalent(file, output, ignored);
    };
    const auto kept = std::find_if(files_.begin(), files_.end(), isOutput);
    if (kept != files_.end())
      throw UsageError(
          option + ": " + output + " is " + kept->string() + ", which is read and stays as it is");
  }

 private:
  std::vector<std::filesystem::path> files_;
};

/** The ending of a name that tells the kind of a file: that before .gz, too. */
inline std::string endingOf(std::filesystem::path name)
{
  if (name.extension() == ".gz") name.replace_extension();
  return name.extension().string();
}

/** What is called .quadmap is read as a map, whatever it is.
 * \param ending That of such outputs. Names may have none, or one that is not of ours.
 * \exception UsageError If the output's name ends as our files of another kind do. */
inline void requireNoOtherEnding(
    const std::string& option, const std::string& output, const std::string& ending)
{
  static const std::vector<std::string> ours{".quadmap", ".simplemap", ".rawlog", ".json", ".tum",
                                             ".graph",   ".3Dscene",   ".html",   ".ply",  ".pcd",
                                             ".glb",     ".png",       ".jpg",    ".ini"};
  const std::string its = endingOf(output);
  if (its != ending && std::find(ours.begin(), ours.end(), its) != ours.end())
    throw UsageError(
        "--" + option + ": files of this kind end in " + ending + ", got '" + output + "'");
}

}  // namespace quadmap::cli
