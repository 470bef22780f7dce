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

/** The edit distance of a word of n letters from a known one, if that one may have been meant: when
 * the distance is at most n / 3, or 1 for short words, and less than n, so that a letter is right.
 * Nothing otherwise. */
std::optional<std::size_t> slipsIn(const std::string& word, const std::string& known);

/** The known word that was most likely meant, the first of several; nothing when none may be. */
std::optional<std::string> mostSimilar(
    const std::string& word, const std::vector<std::string>& known);

}  // namespace quadmap
