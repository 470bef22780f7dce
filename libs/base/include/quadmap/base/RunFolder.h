#pragma once

#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/base/OutputSet.h"
#include "quadmap/base/Temporary.h"

namespace quadmap
{
/** A folder for results. When the run fails, the folders that were made for it are removed. */
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

/** The folder and the files of a run that may be stopped early. The files are locked from the
 * start, so that two runs into one folder exclude each other. */
class RunFolder
{
 public:
  /** \param set Name of the set of files, see OutputSet.
   *  \param report The JSON file of the set in which `input.interrupted` says whether the run was
   *  stopped early.
   *  \param otherResults Names of other files that every run writes into it.
   *  \exception std::runtime_error If the folder cannot be made, or another program writes there.
   */
  RunFolder(
      const std::string& path,
      std::string set,
      std::string report,
      std::vector<std::string> otherResults);

  OutputSet& files() { return *files_; }

  /** To be called by a run that was stopped early, before it adds files: it does not replace the
   *  result of one that was not. A result whose report is missing or damaged may be such a one.
   *  When there is such a result, files() are from now on those of the folder `interrupted` in
   *  this one.
   *  \return A warning that says so; empty when there is no such result. */
  std::string keepCompleteResult();

 private:
  bool hasOtherResults() const;

  std::string path_, set_, report_;
  std::vector<std::string> otherResults_;
  OutputDirectory directory_;
  std::optional<OutputDirectory> interruptedDirectory_;
  std::unique_ptr<OutputSet> files_;
};

}  // namespace quadmap
