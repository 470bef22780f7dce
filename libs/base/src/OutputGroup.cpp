#include "quadmap/base/OutputGroup.h"

#include <exception>
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
  // What a link leads to is written where it is: the folder of the link may be no place to write.
  const std::filesystem::path whole = withoutLink(path);
  const std::string name = whole.filename().string();
  const auto [file, isNew] = files_.try_emplace(whole.string(), whole.parent_path().string(), name);
  return isNew ? file->second.add(name) : file->second.written(name);
}

OutputSet& OutputGroup::addFolder(const std::string& path, const std::string& set)
{
  directories_.emplace_back(path);
  return addToFolder(path, set);
}

OutputSet& OutputGroup::addToFolder(const std::string& path, const std::string& set)
{
  return folders_.emplace_back(path, set);
}

void OutputGroup::commit()
{
  std::vector<OutputSet*> sets;
  for (auto& [path, file] : files_) sets.push_back(&file);
  for (OutputSet& files : folders_) sets.push_back(&files);
  for (OutputSet* files : sets) files->prepare();
  const auto pause = Temporary::pause();
  for (OutputSet* files : sets) files->promise();
  std::exception_ptr first;
  for (OutputSet* files : sets) try
    {
      files->exchange();
    }
    catch (const std::exception&)
    {
      if (!first) first = std::current_exception();
    }
  if (first) std::rethrow_exception(first);
}

}  // namespace quadmap
