#include "quadmap/base/StderrCapture.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>

namespace quadmap
{
namespace
{
std::mutex oneAtATime;
}

StderrCapture::StderrCapture() : alone_(oneAtATime)
{
  std::fflush(stderr);
  kept_ = ::memfd_create("stderr", MFD_CLOEXEC);
  if (kept_ < 0) return;
  terminal_ = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
  if (terminal_ >= 0) ::dup2(kept_, STDERR_FILENO);
}

StderrCapture::~StderrCapture()
{
  std::fflush(stderr);
  if (terminal_ >= 0)
  {
    ::dup2(terminal_, STDERR_FILENO);
    ::close(terminal_);
  }
  if (kept_ >= 0) ::close(kept_);
}

std::string StderrCapture::text() const
{
  constexpr std::size_t kLongest = 1000;  // [bytes]
  std::fflush(stderr);
  std::string text(kLongest, '\0');
  const auto count = kept_ < 0 ? 0 : ::pread(kept_, text.data(), text.size(), 0);
  text.resize(count < 0 ? 0 : static_cast<std::size_t>(count));
  return text;
}

}  // namespace quadmap
