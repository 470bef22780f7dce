#pragma once

#include <string>

namespace quadmap
{
/** A file that appears complete or not at all: write to temporaryPath(), then commit(). Without
 * commit() the destructor removes the temporary file and the final name stays untouched.
 * A final name that is a link stands for what it points to; a device or pipe (/dev/null) cannot be
 * renamed onto and is written directly. */
class OutputFile
{
 public:
  /** \exception std::runtime_error If the directory is missing or not writable. */
  explicit OutputFile(std::string finalPath);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /** In the same directory, with the same extension (writers look at it). */
  const std::string& temporaryPath() const { return temporaryPath_; }
  const std::string& finalPath() const { return finalPath_; }

  /** Checks that the file's data reached the disk (fsync) and renames it. Close the file first.
   *  Some writers swallow errors: a disk that is full by now fails here too.
   *  \exception std::runtime_error For a full disk or a failed rename; names the file. */
  void commit();

 private:
  std::string finalPath_, temporaryPath_;
  bool isDevice_ = false;  //!< Written directly
  bool committed_ = false;
};

/** Writes a whole text that way. \exception std::runtime_error Names the file. */
void writeTextFile(const std::string& path, const std::string& text);

}  // namespace quadmap
