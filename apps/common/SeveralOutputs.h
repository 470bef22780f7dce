#pragma once

#include <string>
#include <utility>
#include <vector>

#include "CommandLine.h"
#include "quadmap/base/SameOutput.h"

namespace quadmap::cli
{
/** The files that one call writes, each with the option that names it, as it is typed. */
using NamedOutputs = std::vector<std::pair<std::string, std::string>>;

/** \exception UsageError If two of them are the same file, whatever name or link leads to it: one
 * would replace the other. */
inline void requireDifferentFiles(const NamedOutputs& outputs)
{
  for (auto second = outputs.begin(); second != outputs.end(); ++second)
    for (auto first = outputs.begin(); first != second; ++first)
      if (isSameOutput(first->second, second->second))
        throw UsageError(
            second->first + ": " + second->second + " is the file of " + first->first +
            " as well; give each its own");
}

}  // namespace quadmap::cli
