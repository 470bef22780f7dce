#pragma once

#include <mrpt/system/progress.h>
#include <unistd.h>

#include <iostream>
#include <string>

namespace quadmap::cli
{
/** Shows a progress bar on a terminal, and nothing elsewhere. */
class ProgressBar
{
 public:
  /** \param share Share that is done, in [0, 1]. \param note A few words behind the bar. */
  void operator()(double share, const std::string& note = {})
  {
    constexpr int kWidth = 40;  // [letters]
    const int percent = static_cast<int>(100 * share);
    if (percent == shownPercent_ || !isatty(STDERR_FILENO)) return;
    shownPercent_ = percent;
    std::cerr << "\r" << mrpt::system::progress(share, kWidth) << note
              << (percent >= 100 ? "\n" : "") << std::flush;
  }

 private:
  int shownPercent_ = -1;
};

}  // namespace quadmap::cli
