#pragma once

#include <mutex>
#include <string>

namespace quadmap
{
/** A file or folder that lasts as long as this object. What exists when a signal ends the program
 * is removed, too: see removeAll(). */
class Temporary
{
 public:
  enum class Kind
  {
    Everything,  //!< A file, or a folder with all that is in it
    EmptyFolder  //!< A folder that stays when something is in it
  };

  explicit Temporary(std::string path, Kind kind = Kind::Everything);
  ~Temporary();  //!< Removes it
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  const std::string& path() const { return path_; }

  /** It stays from now on, or has another name by now. */
  void keep();

  /** removeAll() waits while this lock is held. Hold it from creating a file to constructing its
   * Temporary, and while several files are exchanged. */
  static std::unique_lock<std::recursive_mutex> pause();

  /** Removes all there are. For the end of the program: other threads that make or keep one wait
   * for ever. */
  static void removeAll() noexcept;

 private:
  std::string path_;
  Kind kind_;
  bool kept_ = false;
};

}  // namespace quadmap
