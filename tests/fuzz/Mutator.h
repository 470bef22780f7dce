#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace quadmap
{
/** Damages valid inputs the way broken disks, half transfers and editing by hand do. The same seed
 * gives the same inputs on every machine. */
class Mutator
{
 public:
  explicit Mutator(std::uint32_t seed) : random_(seed) {}

  /** Words worth inserting into a text of the format. */
  std::vector<std::string> dictionary = {"nan",  "-inf", "1e999", "-1", "99999999999999999999",
                                         "0",    "[",    "]",     "\"", "=",
                                         "\\\n", "{",    "\n",    "#",  std::string(1, '\0')};

  /** Any of the inputs. */
  const std::string& choose(const std::vector<std::string>& inputs)
  {
    return inputs[below(inputs.size())];
  }

  /** One to four damages, at random places. */
  std::string mutate(std::string bytes);

 private:
  std::size_t below(std::size_t n) { return random_() % n; }  // n > 0
  void damage(std::string& bytes);
  void overwrite(std::string& bytes, const std::string& value);

  std::mt19937 random_;  // its numbers are the same everywhere, unlike those of distributions
};

}  // namespace quadmap
