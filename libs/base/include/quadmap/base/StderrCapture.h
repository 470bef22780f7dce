#pragma once

#include <mutex>
#include <string>

namespace quadmap
{
/** While it lives, what libraries print to the terminal is kept instead: libpng and libjpeg tell
 * there what is wrong with an image, and name no file. What other threads print meanwhile is kept,
 * too, so it should be short. One lives at a time: another thread that makes one waits, and one
 * thread must not make two. */
class StderrCapture
{
 public:
  StderrCapture();
  ~StderrCapture();
  StderrCapture(const StderrCapture&) = delete;
  StderrCapture& operator=(const StderrCapture&) = delete;

  /** What was printed so far, its beginning if it is long. */
  std::string text() const;

 private:
  std::unique_lock<std::mutex> alone_;  //!< The terminal is the process's
  int terminal_ = -1, kept_ = -1;       //!< Descriptors; -1 when nothing can be kept
};

}  // namespace quadmap
