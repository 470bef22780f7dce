#pragma once

#include <string>
#include <vector>

#include "../obs/TemporaryFolder.h"

namespace quadmap::torture
{
/** One broken input. */
struct Case
{
  std::string name;   //!< What is wrong with it
  std::string bytes;  //!< The whole file
  /** Nothing useful can come of it. Else the damage may be one that nobody can see. */
  bool mustFail = false;
  /** A part that the message must have: it says where the damage is. */
  std::string place = {};
};

/** How one kind of file is read. */
struct Reader
{
  std::string command;  //!< Program and arguments: IN is the file, DIR its folder, OUT a result
  std::string file;     //!< Name of the broken file in the folder
  /** A part of the message, beside the file's own name. */
  std::string mention;
};

/** Gives each case to the program and judges how it ends: by itself with status 0 or 1, within ten
 * seconds of CPU time and 1 GB; when it failed, with one line of its own that names the file, and
 * with no result. The rest of the folder is not changed. */
void judge(const TemporaryFolder& folder, const Reader& reader, const std::vector<Case>& cases);

}  // namespace quadmap::torture
