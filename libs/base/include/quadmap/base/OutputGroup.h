#pragma once

#include <list>
#include <map>
#include <string>

#include "quadmap/base/OutputSet.h"
#include "quadmap/base/RunFolder.h"

namespace quadmap
{
/** What one call of a program writes into any folders: all of it gets its names, or nothing. What
 * may fail comes before the first name is exchanged, and a signal before or after all. A program
 * that is killed while it exchanges them, or a disk that fails then, leaves a part of the files;
 * the others are given their names when they are written next, see OutputSet. */
class OutputGroup
{
 public:
  OutputGroup() = default;
  ~OutputGroup();  //!< Removes what was written, unless commit() was called
  OutputGroup(const OutputGroup&) = delete;
  OutputGroup& operator=(const OutputGroup&) = delete;

  /** Adds a file. \return Where to write it: a device or a pipe is written at once.
   *  \exception std::runtime_error As OutputSet does; names the file. */
  std::string add(const std::string& path);

  /** Adds files of a folder, which is made when missing, and removed again when nothing appears in
   * it. \param set Name of the set. \return Takes its files; do not commit it.
   *  \exception std::runtime_error If the folder cannot be made or written. */
  OutputSet& addFolder(const std::string& path, const std::string& set);

  /** The same for a folder that exists: a missing one is not made, but an error. */
  OutputSet& addToFolder(const std::string& path, const std::string& set);

  /** Gives all files their names. Call it once.
   *  \exception std::runtime_error Names the file that cannot be written. */
  void commit();

 private:
  std::list<OutputDirectory> directories_;  // a later one may lie in an earlier one
  std::map<std::string, OutputSet> files_;  // single files, by their paths
  std::list<OutputSet> folders_;
};

}  // namespace quadmap
