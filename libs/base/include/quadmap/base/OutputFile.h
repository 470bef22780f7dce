#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "quadmap/base/Temporary.h"

namespace quadmap
{
/** A file that appears complete or not at all: write to temporaryPath(), then commit(). Without
 * commit() the destructor, or a signal that ends the program, removes the temporary file and the
 * final name stays untouched. What a program that was killed has left is removed by the next one
 * that writes the same file.
 * The temporary file is locked: write it under its name, and put no other file in its place.
 * A final name that is a link stands for what it points to; a device or pipe (/dev/null) cannot be
 * renamed onto and is written directly. */
class OutputFile
{
 public:
  /** \exception std::runtime_error If the directory is missing or not writable, or nobody reads
   * the pipe. */
  explicit OutputFile(std::string finalPath);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /** In the same directory, with the same extension (writers look at it). */
  const std::string& temporaryPath() const { return temporaryPath_; }
  /** The name it has in the end, for messages. */
  const std::string& finalPath() const { return finalPath_; }

  /** Checks that the file's data reached the disk (fsync) and renames it. Close the file first.
   *  A file that is replaced keeps its permission bits.
   *  Some writers swallow errors: a disk that is full by now fails here too.
   *  \exception std::runtime_error For a full disk or a failed rename; names the file. */
  void commit();

  /** For a writer that failed and does not tell why, as streams do not.
   *  \exception std::runtime_error Always: the file, and the error of the system. */
  [[noreturn]] void fail() const;

 private:
  std::string finalPath_, target_, temporaryPath_;
  std::optional<mode_t> permissions_;  //!< Of the file that is replaced, if there is one
  int descriptor_ = -1;  //!< Descriptor of the locked temporary file, or of a pipe, if there is one
  std::optional<Temporary> temporary_;  //!< Empty for a device, and after commit()
};

/** Why a file could not be written by code that does not tell it: the error that the system gives
 * to whoever writes more to it, which is done here, as an errno; 0 when there is none. */
int errorOfWritingTo(const std::string& path);

/** Writes a whole text that way. \exception std::runtime_error Names the file. */
void writeTextFile(const std::string& path, const std::string& text);

}  // namespace quadmap
