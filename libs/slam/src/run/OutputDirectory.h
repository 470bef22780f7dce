#pragma once

#include <list>
#include <string>

#include "quadmap/base/Temporary.h"

namespace quadmap
{
/** The output directory. When the run fails, the directories that were made for it are removed. */
class OutputDirectory
{
 public:
  /** \exception std::runtime_error If it cannot be made. */
  explicit OutputDirectory(const std::string& path);
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

 private:
  std::list<Temporary> made_;  //!< The deepest last
};

/** Whether a folder has the result of a run that nobody stopped. */
bool hasCompleteResult(const std::string& directory);

}  // namespace quadmap
