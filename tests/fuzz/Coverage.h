#pragma once

namespace quadmap
{
/** What of the program ran, where the compiler was told to count it (preset asan). Elsewhere
 * nothing is ever new. */
struct Coverage
{
  /** From here on is counted anew. */
  static void reset();
  /** True when since reset() an edge of the control flow ran that no call of foundNew() has seen
   * run, or one ran by far more or fewer times than in any. */
  static bool foundNew();
};

}  // namespace quadmap
