#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace quadmap::torture
{
constexpr int kRequests = 198, kEndings = 199;  //!< Descriptors of the pipes, in the program

constexpr unsigned kSeconds = 10;             //!< Longest run, of CPU time: others run beside it
constexpr unsigned kSecondsWaiting = 30;      //!< Longest run by the clock, as one that hangs
constexpr rlim_t kMachine = rlim_t{8} << 30;  //!< Most memory, so that a failing case harms nobody

/** How a run ended. */
struct Ended
{
  int status = 0;  //!< As of wait()
  long kilobytes = 0;
};

/** A request: the files for stdout and stderr, then the arguments, from the name of the program on.
 * Each word ends with a zero, and so does the list. */
inline std::string requestOf(const std::vector<std::string>& words)
{
  std::string bytes;
  for (const auto& word : words) bytes += word + '\0';
  return bytes + '\0';
}

/** The words of the next request; nothing at the end. */
inline std::optional<std::vector<std::string>> readWords(int descriptor)
{
  std::vector<std::string> words;
  std::string word;
  for (char c = 0; ::read(descriptor, &c, 1) == 1;)
    if (c != '\0')
      word += c;
    else if (word.empty())
      return words;
    else
      words.push_back(std::exchange(word, {}));
  return std::nullopt;
}

}  // namespace quadmap::torture
