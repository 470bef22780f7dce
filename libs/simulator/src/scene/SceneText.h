#pragma once

#include <mrpt/config/CConfigFileBase.h>

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

namespace quadmap::simulator
{
/** The words of a value, which blanks or commas separate. */
std::vector<std::string> wordsOf(const std::string& text);

/** One key of a scene file, with its text. */
struct Entry
{
  std::string section, key, text;

  /** \exception std::invalid_argument Always. The message names section, key, text and reason. */
  [[noreturn]] void reject(const std::string& why) const;

  double number(const std::string& word, double min, double max) const;

  /** The vector in the words [first, first + 3). */
  Eigen::Vector3d vector(
      const std::vector<std::string>& words, std::size_t first, double min, double max) const;

  /** The vector of a text of three numbers. */
  Eigen::Vector3d vector(double min, double max) const;
};

/** The entry of a key, or nothing when the section has no such key. */
std::optional<Entry> entryOf(
    const mrpt::config::CConfigFileBase& config,
    const std::string& section,
    const std::string& key);

/** The keys PREFIX1, PREFIX2, ... of a section, in the order of their numbers: 10 comes after 9.
 * \exception std::invalid_argument For a key that begins with the prefix and does not end in a
 * whole number, and for a number that occurs twice, such as 1 and 01. */
std::vector<Entry> numberedEntries(
    const mrpt::config::CConfigFileBase& config,
    const std::string& section,
    const std::string& prefix);

}  // namespace quadmap::simulator
