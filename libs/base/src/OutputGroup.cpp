#include "quadmap/base/OutputGroup.h"

#include <filesystem>
#include <vector>

#include "FileSystem.h"

namespace quadmap
{
OutputGroup::~OutputGroup()
{
  folders_.clear();
  files_.clear();
  while (!directories_.empty()) directories_.pop_back();
}

std::string OutputGroup::add(const std::string& path)
{
  if (isDevice(path)) return path;
  const std::filesystem::path whole(path);
  const std::string folder = whole.parent_path().string(), name = whole.filename().string();
  auto& files = files_[folder];
  if (!files) files = std::make_unique<OutputSet>(folder, name);
  return files->add(name);
}

OutputSet& OutputGroup::addFolder(const std::string& path, const std::string& set)
{
  directories_.emplace_back(path);
  return folders_.emplace_back(path, set);
}

void OutputGroup::commit()
{
  std::vector<OutputSet*> sets;
  for (auto& [folder, files] : files_) sets.push_back(files.get());
  for (OutputSet& files : folders_) sets.push_back(&files);
  for (OutputSet* files : sets) files->prepare();
  const auto pause = Temporary::pause();
  for (OutputSet* files : sets) files->exchange();
}

}  // namespace quadmap
