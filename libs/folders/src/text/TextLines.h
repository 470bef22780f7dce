#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "quadmap/obs/Plausible.h"

namespace quadmap
{
/** One line of a text file, cut at blanks. */
struct TextLine
{
  std::string place;  //!< "file:12", for messages
  std::vector<std::string> words;
};

/** All lines of a file that are neither empty nor comments, which begin with '#'.
 * \param unusable Receives why lines are left out that are no text; null: that is an error.
 * \exception std::runtime_error If the file cannot be read, or has more than 16 MB: three hours of
 * images at 30 Hz. */
std::vector<TextLine> readTextLines(
    const std::string& path, std::vector<std::string>* unusable = nullptr);

/** \exception std::runtime_error If the line has another number of columns. */
void requireColumns(const TextLine& line, std::size_t columns);

/** The number in a column. It may be NaN or infinite; the caller decides whether it can be used.
 * \exception std::runtime_error If it is no number. */
double numberIn(const TextLine& line, std::size_t column);

/** The time in a column [s]. \exception std::runtime_error If it is not in [0, kLatestTime]. */
double timeIn(const TextLine& line, std::size_t column);

}  // namespace quadmap
