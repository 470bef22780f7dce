#pragma once

#include <algorithm>
#include <iostream>
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

/** Where a program tells what it did: where it prints, unless its output goes there, which the text
 * would spoil. Ask before the output is written. */
inline std::ostream& messagesBeside(const std::string& output)
{
  return isStandardOutput(output) ? std::cerr : std::cout;
}

/** The same for several outputs. */
inline std::ostream& messagesBeside(const NamedOutputs& outputs)
{
  const auto isTaken = [](const auto& output) { return isStandardOutput(output.second); };
  return std::any_of(outputs.begin(), outputs.end(), isTaken) ? std::cerr : std::cout;
}

}  // namespace quadmap::cli
