#pragma once

#include <sys/resource.h>

#include <csignal>

namespace quadmap
{
/** While it lives, no file can grow beyond a size, so that writes fail as on a full disk. Programs
 * that are started meanwhile inherit the limit. */
class FileSizeLimit
{
 public:
  explicit FileSizeLimit(rlim_t bytes)
  {
    oldAction_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit()
  {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, oldAction_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit old_{};
  void (*oldAction_)(int) = nullptr;
};

}  // namespace quadmap
