#include "scene/SceneConfig.h"

#include <mrpt/config/CConfigFile.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "quadmap/base/ConfigCheck.h"
#include "quadmap/base/ShareFiles.h"
#include "quadmap/obs/LabelTable.h"
#include "scene/SceneText.h"

namespace quadmap::simulator
{
namespace
{
const std::string kInclude = "include";

std::string includedFile(const Entry& entry, const std::string& fromFile)
{
  const auto beside = std::filesystem::path(fromFile).parent_path() / entry.text;
  if (std::filesystem::exists(beside)) return beside.string();
  try
  {
    return findShareFile("scenes/" + entry.text);
  }
  catch (const std::exception& e)
  {
    entry.reject(e.what());
  }
}

/** The files that a file includes, in the order of their numbers. */
std::vector<std::string> filesIncludedBy(
    const mrpt::config::CConfigFileBase& config, const std::string& path)
{
  std::vector<std::string> keys, files;
  config.getAllKeys(kInclude, keys);
  for (const auto& key : keys)
    if (key.compare(0, 4, "file") != 0)
      throw std::runtime_error(
          path + ": [include] unknown key \"" + key + "\"; known: file1, file2, ...");
  try
  {
    for (const auto& entry : numberedEntries(config, kInclude, "file"))
      files.push_back(includedFile(entry, path));
  }
  catch (const std::invalid_argument& e)
  {
    throw std::runtime_error(path + ": " + e.what());
  }
  return files;
}

}  // namespace

SceneConfig::SceneConfig(const std::string& path) { add(path); }

void SceneConfig::add(const std::string& path)
{
  requireReadableIni(path);
  files_.push_back(path);
  const mrpt::config::CConfigFile file(path);
  std::vector<std::string> sections;
  file.getAllSections(sections);
  for (const auto& section : sections)
  {
    if (section == kInclude) continue;
    const std::string name = "[" + section + "]";
    if (fileOf_.emplace(name, path).second) sections_.push_back(section);
    std::vector<std::string> keys;
    file.getAllKeys(section, keys);
    for (const auto& key : keys)
      if (fileOf_.emplace(name + " " + key, path).second)
        config_.write(section, key, file.read_string(section, key, ""));
  }
  for (const auto& included : filesIncludedBy(file, path))
    if (std::find(files_.begin(), files_.end(), included) == files_.end()) add(included);
}

std::string SceneConfig::fileOf(const std::string& message) const
{
  const auto section = message.find(']');
  if (message.empty() || message[0] != '[' || section == std::string::npos) return files_.front();
  const auto key = message.find_first_of("=: ", section + 2);
  for (const auto end : {key, section + 1})
  {
    const auto found = fileOf_.find(message.substr(0, end));
    if (found != fileOf_.end()) return found->second;
  }
  return files_.front();
}

}  // namespace quadmap::simulator
