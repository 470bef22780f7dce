#include "run/OutputDirectory.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "quadmap/base/Json.h"

namespace quadmap
{
namespace fs = std::filesystem;

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

bool hasCompleteResult(const std::string& directory)
{
  const std::string report = directory + "/report.json";
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

}  // namespace quadmap
