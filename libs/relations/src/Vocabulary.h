#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "quadmap/relations/Inventory.h"

namespace quadmap
{
/** A text in lower case as its words: letters and digits; all else separates them. Bytes beyond
 * ASCII are letters. */
std::vector<std::string> wordsOf(const std::string& text);

/** What the words of questions about an inventory mean. */
class Vocabulary
{
 public:
  /** The inventory has to outlive this. */
  explicit Vocabulary(const Inventory& inventory);

  /** A label without regard to its spelling. */
  std::string keyOf(const std::string& label) const;

  /** Keys of the labels that a noun of some words means, in singular or plural: the label with this
   * spelling, and those that end with these words. Empty when nobody knows the noun. */
  std::set<std::string> labelsMeantBy(const std::vector<std::string>& noun) const;

  /** The known words that are spelt most like one that is not: labels of the objects, spellings of
   * the label table, words of questions, labels of which one word is spelt so; at most three, best
   * first.
   * \param grammar The words of questions. */
  std::vector<std::string> similarTo(
      const std::string& word, const std::set<std::string>& grammar) const;

 private:
  const LabelTable& table_;
  /** Labels of the objects and classes of the table as words, with their keys. */
  std::map<std::vector<std::string>, std::string> keyByWords_;
  std::set<std::string> objectLabels_;
};

}  // namespace quadmap
