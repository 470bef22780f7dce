#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace quadmap
{
/** A folder for one test, which is removed at its end with everything in it. */
class TemporaryFolder
{
 public:
  TemporaryFolder()
  {
    auto pattern = (std::filesystem::temp_directory_path() / "quadmap-test-XXXXXX").string();
    if (!::mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder: " + pattern);
    folder_ = pattern;
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  const std::filesystem::path& folder() const { return folder_; }

  /** Writes a file of the folder. \return Its path. */
  std::string write(const std::string& name, const std::string& content) const
  {
    std::filesystem::remove(path(name));  // file systems flush a file that is cut to nothing
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }

  /** Number of all files, including hidden ones. */
  std::size_t fileCount() const
  {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_)) ++count;
    return count;
  }

 private:
  std::filesystem::path folder_;
};

inline std::string readFile(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  return content.str();
}

/** The message of the std::exception that `f` throws, or an empty text when it throws none. */
template <typename F>
std::string errorOf(F&& f)
{
  try
  {
    f();
  }
  catch (const std::exception& e)
  {
    return e.what();
  }
  return {};
}

}  // namespace quadmap
