#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadmap/base/Temporary.h"

namespace quadmap
{
/** Several files of one folder that belong together: all of them get their names, or none.
 *
 * They are written into a hidden folder beside, FOLDER/.NAME.partial. commit() first writes the
 * list of the files into it, then moves them one by one, and removes the hidden folder last. A
 * program that is killed before the list exists has changed nothing. One that is killed after it
 * leaves a mixture which all our readers refuse (requireOneRun()), and which the next program that
 * writes the set completes.
 *
 * Two programs cannot write one set at the same time. A program that died locks nothing. */
class OutputSet
{
 public:
  /** Locks the set. \param folder It exists; empty: where the program was started, and messages
   *  then have the names alone. \param name Name of the set, unique in the folder.
   *  \exception std::runtime_error If another program writes the set, or for a folder that is
   *  missing or not writable. */
  OutputSet(std::string folder, const std::string& name);
  ~OutputSet();  //!< Removes what was written, unless commit() was called
  OutputSet(const OutputSet&) = delete;
  OutputSet& operator=(const OutputSet&) = delete;

  const std::string& folder() const { return folder_; }

  /** Adds a file. \return Where to write it.
   *  \exception std::runtime_error If its name is that of a folder. */
  std::string add(const std::string& name);

  /** Adds a folder, which is made. \return Where to write its files.
   *  \exception std::runtime_error If there is anything of that name. */
  std::string addFolder(const std::string& name);

  /** Where a file that was added is written. */
  std::string written(const std::string& name) const { return staging_ + "/" + name; }

  /** Names of the files that were added. */
  std::vector<std::string> names() const;

  /** An older file of that name is removed by commit(): it does not belong to the new ones. */
  void addRemoval(const std::string& name);

  /** Gives all files their names. They keep the permissions of those they replace, and links stay
   *  links. Call it once. \exception std::runtime_error Names the file that cannot be written. */
  void commit();

  /** The parts of commit(), in their order, for whoever commits several sets (OutputGroup). */
  void prepare();   //!< What may fail. \exception std::runtime_error Names the file.
  void promise();   //!< From here on readers refuse the files that are to be replaced.
  void exchange();  //!< \exception std::runtime_error Names the file; the next writer goes on.

 private:
  std::string named(const std::string& name) const;  //!< The path that a file will have

  std::string folder_, staging_;
  std::vector<std::string> entries_;  //!< Names with '+' before them, or '-' when removed
  int lock_ = -1;                     //!< Descriptor of the locked folder
  std::optional<Temporary> temporary_;
};

/** \exception std::runtime_error If the file belongs to a set of which some files were replaced
 * and others not, as a program was killed at that moment. */
void requireOneRun(const std::string& file);

/** The path that a file of a set will have; other paths are returned as they are. */
std::string pathAfterCommit(const std::string& path);

}  // namespace quadmap
