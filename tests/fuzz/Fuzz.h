#pragma once

#include <functional>
#include <string>

#include "Mutator.h"

namespace quadmap
{
struct FuzzRun
{
  std::uint32_t seed = 1;
  int count = 500;
  /** A parser must not ask for more memory at once than a small multiple of its input and of the
   *  largest object its format allows. */
  std::size_t largestAllocation = std::size_t{1} << 27;  // [bytes]
  std::vector<std::string> words;                        // added to the mutator's dictionary
  bool mostlyHarmless = false;  // the parser is meant to put up with most damages
  std::string place;            // each error names it, such as the file; empty: need not
};

/** Gives `parse` the valid input, which it must accept, and then damaged versions of it, and of
 * those by which the parser ran as it had not before, where coverage is counted. It may
 * accept them or throw a std::exception that tells the place; anything else, a request for absurd
 * amounts of memory or taking long fails the test (and a crash ends it). */
void fuzz(
    const std::string& valid,
    const FuzzRun& run,
    const std::function<void(const std::string&)>& parse);

}  // namespace quadmap
