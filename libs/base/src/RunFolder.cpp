#include "quadmap/base/RunFolder.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "quadmap/base/Json.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

/** Whether a report is that of a run that was stopped early; nothing when it does not tell. */
std::optional<bool> isOfStoppedRun(const std::string& report)
{
  try
  {
    return readJson(report).at("input").at("interrupted").get<bool>();
  }
  catch (const std::exception&)
  {
    return std::nullopt;
  }
}
}  // namespace

OutputDirectory::OutputDirectory(const std::string& path)
{
  std::error_code error;
  const auto pause = Temporary::pause();
  for (fs::path p = path; !p.empty() && !fs::exists(p, error); p = p.parent_path())
    made_.emplace_front(p.string(), Temporary::Kind::EmptyFolder);
  fs::create_directories(path, error);
  if (!error && fs::is_directory(path)) return;
  throw std::runtime_error(
      path + ": cannot be made: " + (error ? error.message() : "a file of that name exists"));
}

OutputDirectory::~OutputDirectory()
{
  while (!made_.empty()) made_.pop_back();
}

RunFolder::RunFolder(
    const std::string& path,
    std::string set,
    std::string report,
    std::vector<std::string> otherResults) :
    path_(path),
    set_(std::move(set)),
    report_(std::move(report)),
    otherResults_(std::move(otherResults)),
    directory_(path_),
    files_(std::make_unique<OutputSet>(path_, set_))
{
}

bool RunFolder::hasOtherResults() const
{
  return std::any_of(
      otherResults_.begin(), otherResults_.end(),
      [this](const auto& name)
      {
        std::error_code unknown;
        return fs::exists(path_ + "/" + name, unknown);
      });
}

std::string RunFolder::keepCompleteResult()
{
  const auto wasStopped = isOfStoppedRun(path_ + "/" + report_);
  if (wasStopped ? *wasStopped : !hasOtherResults()) return {};
  const std::string folder = path_ + "/interrupted";
  interruptedDirectory_.emplace(folder);
  files_ = std::make_unique<OutputSet>(folder, set_);
  const std::string earlier =
      wasStopped ? "that was not interrupted"
                 : "of which " + report_ + " does not tell whether it was interrupted";
  return path_ + ": keeps the result of an earlier run " + earlier + "; this one is in " + folder +
         " (--replace puts it in its place)";
}

}  // namespace quadmap
