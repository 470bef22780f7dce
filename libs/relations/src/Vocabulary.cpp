#include "Vocabulary.h"

#include <algorithm>
#include <cctype>
#include <tuple>

#include "quadmap/base/SimilarWords.h"

namespace quadmap
{
namespace
{
bool isLetter(char c)
{
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x80 || std::isalnum(byte) != 0;
}

std::string joined(const std::vector<std::string>& words, const char* between)
{
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

bool endsWith(const std::string& word, const std::string& end)
{
  return word.size() > end.size() && word.compare(word.size() - end.size(), end.size(), end) == 0;
}

/** The words of which this one may be the plural, and itself. */
std::vector<std::string> singularsOf(const std::string& word)
{
  static const std::map<std::string, std::string> kIrregular = {
      {    "mice", "mouse"},
      {     "men",   "man"},
      {   "women", "woman"},
      {"children", "child"}
  };
  static const std::pair<const char*, const char*> kEndings[] = {
      {"ies",  "y"},
      {"ves",  "f"},
      {"ves", "fe"},
      { "es",   ""},
      {  "s",   ""}
  };
  std::vector<std::string> singulars = {word};
  if (const auto found = kIrregular.find(word); found != kIrregular.end())
    singulars.push_back(found->second);
  for (const auto& [plural, singular] : kEndings)
    if (endsWith(word, plural))
      singulars.push_back(word.substr(0, word.size() - std::string(plural).size()) + singular);
  return singulars;
}

bool endsWith(const std::vector<std::string>& words, const std::vector<std::string>& end)
{
  return words.size() >= end.size() && std::equal(end.rbegin(), end.rend(), words.rbegin());
}

}  // namespace

std::vector<std::string> wordsOf(const std::string& text)
{
  std::vector<std::string> words;
  bool goesOn = false;
  for (const char c : text)
  {
    if (c == '\'') continue;
    const bool belongs = isLetter(c);
    if (belongs && !goesOn) words.emplace_back();
    if (belongs) words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    goesOn = belongs;
  }
  return words;
}

Vocabulary::Vocabulary(const Inventory& inventory) : table_(inventory.labels)
{
  for (const auto& [name, properties] : table_.all()) keyByWords_[wordsOf(name)] = keyOf(name);
  for (const InventoryItem& item : inventory.items)
  {
    const std::string& label = item.record.label;
    keyByWords_[wordsOf(label)] = keyOf(label);
    objectLabels_.insert(joined(wordsOf(label), " "));
  }
}

std::string Vocabulary::keyOf(const std::string& label) const
{
  return joined(wordsOf(table_.canonical(label)), "");
}

std::set<std::string> Vocabulary::labelsMeantBy(const std::vector<std::string>& noun) const
{
  std::set<std::string> keys;
  if (noun.empty()) return keys;
  for (const std::string& last : singularsOf(noun.back()))
  {
    std::vector<std::string> words = noun;
    words.back() = last;
    const auto spelling = table_.spellings().find(joined(words, ""));
    if (spelling != table_.spellings().end()) keys.insert(keyOf(spelling->second));
    for (const auto& [known, key] : keyByWords_)
      if (endsWith(known, words)) keys.insert(key);
  }
  return keys;
}

std::vector<std::string> Vocabulary::similarTo(
    const std::string& word, const std::set<std::string>& grammar) const
{
  constexpr std::size_t kMost = 3;
  // Slips; labels of the objects, other words, labels of which one word is alike; the alphabet.
  std::set<std::tuple<std::size_t, int, std::string>> ranked;
  const auto offer = [&](const std::string& spelling, int rank, const std::string& shown)
  {
    if (const auto slips = slipsIn(word, spelling)) ranked.emplace(*slips, rank, shown);
  };
  for (const std::string& label : objectLabels_) offer(joined(wordsOf(label), ""), 0, label);
  for (const auto& [spelling, name] : table_.spellings())
    offer(spelling, 1, joined(wordsOf(name), "") == spelling ? name : spelling);
  for (const auto& [words, key] : keyByWords_)
    for (const std::string& part : words) offer(part, 2, joined(words, " "));
  for (const std::string& known : grammar) offer(known, 1, known);

  std::vector<std::string> best;
  for (const auto& [slips, rank, shown] : ranked)
    if (best.size() < kMost && std::find(best.begin(), best.end(), shown) == best.end())
      best.push_back(shown);
  return best;
}

}  // namespace quadmap
