#include "FileSystem.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <stdexcept>

#include "quadmap/base/OutputSet.h"

namespace quadmap
{
namespace fs = std::filesystem;

void failToWrite(const std::string& path, int error)
{
  throw std::runtime_error(pathAfterCommit(path) + ": cannot be written: " + std::strerror(error));
}

std::vector<fs::path> linkChain(const fs::path& path)
{
  constexpr std::size_t kMostLinks = 40;  // as many as Linux follows
  std::vector<fs::path> chain{path};
  std::error_code error;
  while (chain.size() <= kMostLinks && fs::is_symlink(chain.back(), error))
    chain.push_back(  // what it reads may be absolute
        chain.back().parent_path() / fs::read_symlink(chain.back(), error));
  return chain;
}

fs::path withoutLink(const fs::path& path)
{
  const fs::path end = linkChain(path).back();
  // What /dev/stdout links to may be a pipe without a name, which only the link opens.
  return isDevice(path) && !isDevice(end) ? path : end;
}

fs::path placeOf(const fs::path& path, std::error_code& error)
{
  const fs::path absolute = fs::absolute(path, error);
  if (error) return path;
  // weakly_canonical() alone does not follow a link to what does not exist yet.
  return fs::weakly_canonical(withoutLink(absolute), error);
}

bool isDevice(const fs::path& path)
{
  std::error_code ignored;
  const auto type = fs::status(path, ignored).type();
  return type == fs::file_type::character || type == fs::file_type::fifo ||
         type == fs::file_type::block || type == fs::file_type::socket;
}

std::optional<mode_t> permissionsOf(const fs::path& path)
{
  struct stat s;
  if (::stat(path.c_str(), &s) != 0) return std::nullopt;
  return s.st_mode & (S_IRWXU | S_IRWXG | S_IRWXO);
}

void syncFolder(const fs::path& folder)
{
  const int descriptor =
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);  // some file systems cannot; then there is nothing more to be done
  ::close(descriptor);
}

}  // namespace quadmap
