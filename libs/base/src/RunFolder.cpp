#include "quadmap/base/RunFolder.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "quadmap/base/Json.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

/** Whether a report is that of a run that nobody stopped. */
bool isOfCompleteRun(const std::string& report)
{
  if (!fs::exists(report)) return false;
  try
  {
    return readJson(report).at("input").at("interrupted") == false;
  }
  catch (const std::exception&)  // what cannot be read cannot be lost
  {
    return false;
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

RunFolder::RunFolder(const std::string& path, std::string set, std::string report) :
    path_(path),
    set_(std::move(set)),
    report_(std::move(report)),
    directory_(path_),
    files_(std::make_unique<OutputSet>(path_, set_))
{
}

std::string RunFolder::keepCompleteResult()
{
  if (!isOfCompleteRun(path_ + "/" + report_)) return {};
  const std::string folder = path_ + "/interrupted";
  interruptedDirectory_.emplace(folder);
  files_ = std::make_unique<OutputSet>(folder, set_);
  return path_ + ": keeps the result of an earlier run that was not interrupted; this one is in " +
         folder + " (--replace puts it in its place)";
}

}  // namespace quadmap
