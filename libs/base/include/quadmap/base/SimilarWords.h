#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace quadmap
{
/** Smallest number of letters that have to be put in, left out, replaced or exchanged with their
 * neighbour to make one word of the other. */
std::size_t editDistance(const std::string& a, const std::string& b);

/** The edit distance of a word from the known one that may have been meant, as at most a third of
 * the letters, and one in any case, are wrong; nothing when too many are. */
std::optional<std::size_t> slipsIn(const std::string& word, const std::string& known);

/** The known word that was most likely meant, the first of several; nothing when none may be. */
std::optional<std::string> mostSimilar(
    const std::string& word, const std::vector<std::string>& known);

}  // namespace quadmap
