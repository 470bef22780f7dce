#pragma once

#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <iostream>
#include <string>

namespace quadmap::cli
{
/** One line of a terminal that is written anew a few times a second. Elsewhere nothing is shown. */
class StatusLine
{
 public:
  ~StatusLine() { end(); }

  /** \param text Makes the text; it is not called when none is shown. */
  template <typename Text>
  void show(Text&& text)
  {
    const auto now = std::chrono::steady_clock::now();
    if (!isTerminal_ || (isShown_ && now - shown_ < kPause)) return;
    shown_ = now;
    isShown_ = true;
    std::string line = text();
    if (line.size() >= columns()) line.resize(columns() - 1);
    std::cerr << "\r" << line << "\x1b[K" << std::flush;  // and clears the rest of the line
  }

  /** What is printed next begins a new line. */
  void end()
  {
    if (isShown_) std::cerr << std::endl;
    isShown_ = false;
  }

 private:
  static constexpr std::chrono::milliseconds kPause{200};

  static std::size_t columns()
  {
    winsize size = {};
    const bool isKnown = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return isKnown ? size.ws_col : 80;
  }

  bool isTerminal_ = isatty(STDERR_FILENO) != 0, isShown_ = false;
  std::chrono::steady_clock::time_point shown_;
};

}  // namespace quadmap::cli
