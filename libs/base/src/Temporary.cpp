#include "quadmap/base/Temporary.h"

#include <algorithm>
#include <filesystem>
#include <vector>

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

/** Never destroyed: the thread that receives signals may need it while the program ends. */
struct Registry
{
  std::recursive_mutex mutex;
  std::vector<const Temporary*> all;
};

Registry& registry()
{
  static auto* registry = new Registry;
  return *registry;
}

void removeFrom(const fs::path& path, Temporary::Kind kind)
{
  std::error_code ignored;
  if (kind == Temporary::Kind::Everything)
    fs::remove_all(path, ignored);
  else if (fs::is_directory(path, ignored))
    fs::remove(path, ignored);  // fails when something is in it
}

}  // namespace

Temporary::Temporary(std::string path, Kind kind) : path_(std::move(path)), kind_(kind)
{
  const auto lock = pause();
  registry().all.push_back(this);
}

Temporary::~Temporary()
{
  const auto lock = pause();
  if (!kept_) removeFrom(path_, kind_);
  keep();
}

void Temporary::keep()
{
  const auto lock = pause();
  auto& all = registry().all;
  all.erase(std::remove(all.begin(), all.end(), this), all.end());
  kept_ = true;
}

std::unique_lock<std::recursive_mutex> Temporary::pause()
{
  return std::unique_lock(registry().mutex);
}

void Temporary::removeAll() noexcept
{
  pause().release();  // locked for ever
  auto& all = registry().all;
  for (auto it = all.rbegin(); it != all.rend(); ++it)
  {
    // Another thread may still make files in a folder, but not once the folder has another name.
    std::error_code error;
    fs::path path = (*it)->path_;
    const bool renames = (*it)->kind_ == Kind::Everything && fs::is_directory(path, error);
    if (renames) fs::rename(path, path.string() + ".removed", error);
    if (renames && !error) path += ".removed";
    removeFrom(path, (*it)->kind_);
  }
}

}  // namespace quadmap
