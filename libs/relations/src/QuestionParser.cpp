#include "QuestionParser.h"

#include <algorithm>
#include <iterator>

#include "quadmap/base/ErrorText.h"
#include "quadmap/relations/Questions.h"

namespace quadmap
{
namespace
{
struct Phrase
{
  const char* words;
  RelationKind kind;
};

/** Longer phrases stand before those they begin with. */
constexpr Phrase kRelations[] = {
    {  "on top of",        RelationKind::On},
    {         "on",        RelationKind::On},
    {  "inside of",        RelationKind::In},
    {     "inside",        RelationKind::In},
    {"in front of", RelationKind::InFrontOf},
    {         "in",        RelationKind::In},
    { "underneath",     RelationKind::Under},
    {      "under",     RelationKind::Under},
    {      "below",     RelationKind::Under},
    {    "beneath",     RelationKind::Under},
    {    "next to",    RelationKind::NextTo},
    {     "beside",    RelationKind::NextTo},
    {    "near to",      RelationKind::Near},
    {       "near",      RelationKind::Near},
    {   "close to",      RelationKind::Near},
    {     "behind",    RelationKind::Behind},
    {    "between",   RelationKind::Between}
};

constexpr Phrase kExtremes[] = {
    { "nearest",  RelationKind::Nearest},
    { "closest",  RelationKind::Nearest},
    {"farthest", RelationKind::Farthest},
    {"furthest", RelationKind::Farthest}
};

const std::set<std::string> kSilent = {"a",    "all",   "an",   "and",  "any",  "are",   "every",
                                       "find", "is",    "list", "of",   "show", "some",  "that",
                                       "the",  "there", "was",  "were", "what", "where", "which"};

const std::set<std::string> kAnything = {"anything", "everything", "item",  "items", "object",
                                         "objects",  "something",  "thing", "things"};

const std::set<std::string> kTowards = {"from", "to"};

bool isNumber(const std::string& word)
{
  return word.find_first_not_of("0123456789") == std::string::npos;
}

class Parser
{
 public:
  Parser(std::vector<std::string> words, const Vocabulary& vocabulary) :
      words_(std::move(words)), vocabulary_(vocabulary)
  {
  }

  Question parse()
  {
    skip(kSilent);
    if (isAtEnd()) throw QuestionError("the question is empty; ask for example \"cup on table\"");
    const bool hasSubject = !isAboutAnything();
    takeExtreme();
    skip(kSilent);
    if (hasSubject && !isAtEnd() && !isRelationAhead()) question_.subject = takeNoun();
    if (!hasSubject) takeReference();
    for (skip(kSilent); !isAtEnd(); skip(kSilent)) takeClause();
    return question_;
  }

 private:
  bool isAtEnd() const { return at_ == words_.size(); }
  const std::string& word() const { return words_[at_]; }

  void skip(const std::set<std::string>& words)
  {
    while (!isAtEnd() && words.count(word()) != 0) ++at_;
  }

  bool isAhead(const Phrase& phrase) const
  {
    const std::vector<std::string> wanted = wordsOf(phrase.words);
    return words_.size() - at_ >= wanted.size() &&
           std::equal(
               wanted.begin(), wanted.end(), words_.begin() + static_cast<std::ptrdiff_t>(at_));
  }

  template <std::size_t N>
  const Phrase* ahead(const Phrase (&phrases)[N]) const
  {
    const auto found = std::find_if(
        std::begin(phrases), std::end(phrases), [&](const Phrase& p) { return isAhead(p); });
    return found == std::end(phrases) ? nullptr : found;
  }

  bool isRelationAhead() const { return ahead(kRelations) || ahead(kExtremes); }

  /** Whether an extreme is ahead that has no label of its own: "what is nearest to the tv", "what
   *  is nearest the tv". "The nearest tv" and "nearest tv" ask for a tv. */
  bool isAboutAnything() const
  {
    if (!ahead(kExtremes)) return false;
    std::size_t next = at_ + 1;
    while (next < words_.size() && kSilent.count(words_[next]) != 0) ++next;
    if (next < words_.size() && kTowards.count(words_[next]) != 0) return true;
    const bool asksWhat = at_ > 1 && (words_[0] == "what" || words_[0] == "which");
    return asksWhat && words_[at_ - 1] != "the" && next > at_ + 1;
  }

  /** What the extreme of isAboutAnything() refers to. */
  void takeReference()
  {
    std::string before = textOf(*question_.extreme);
    if (!isAtEnd() && kTowards.count(word()) != 0) before = words_[at_++];
    question_.extremeTo = takeNounAfter(before);
  }

  bool takeExtreme()
  {
    const Phrase* found = question_.extreme ? nullptr : ahead(kExtremes);
    if (!found) return false;
    question_.extreme = found->kind;
    ++at_;
    return true;
  }

  void takeClause()
  {
    const bool isExtremeHere = takeExtreme();  // "chair nearest the tv"
    skip(kSilent);
    if (question_.extreme && !question_.extremeTo && !isAtEnd() && kTowards.count(word()) != 0)
    {
      const std::string towards = words_[at_++];
      question_.extremeTo = takeNounAfter(towards);
      return;
    }
    if (isExtremeHere && !isAtEnd() && !isRelationAhead()) question_.extremeTo = takeNoun();
    if (isExtremeHere) return;
    const Phrase* relation = ahead(kRelations);
    if (!relation) failAtWord();
    at_ += wordsOf(relation->words).size();
    Clause clause;
    clause.kind = relation->kind;
    clause.object = takeNounAfter(relation->words);
    if (clause.kind == RelationKind::Between) clause.second = takeSecond(clause.object);
    question_.clauses.push_back(clause);
  }

  /** The second noun of "between the tv and the book"; of "between the chairs" the same one. */
  Noun takeSecond(const Noun& first)
  {
    if (isAtEnd() || word() != "and") return first;
    ++at_;
    return takeNounAfter("and");
  }

  Noun takeNounAfter(const std::string& words)
  {
    skip(kSilent);
    if (isAtEnd()) throw QuestionError("\"" + words + "\" what? The question ends there");
    return takeNoun();
  }

  Noun takeNoun()
  {
    Noun noun;
    if (kAnything.count(word()) != 0)
      ++at_;
    else if (!isNumber(word()))
      takeLabel(noun);
    if (!isAtEnd() && isNumber(word()))
    {
      noun.text += " " + word();
      noun.id = words_[at_++];
    }
    return noun;
  }

  /** The label with the most words that begins here. */
  void takeLabel(Noun& noun)
  {
    constexpr std::size_t kMostWords = 5;
    for (std::size_t count = std::min(kMostWords, words_.size() - at_); count > 0; --count)
    {
      const auto from = words_.begin() + static_cast<std::ptrdiff_t>(at_);
      const std::vector<std::string> words(from, from + static_cast<std::ptrdiff_t>(count));
      noun.labels = vocabulary_.labelsMeantBy(words);
      if (noun.labels.empty()) continue;
      noun.text = words.front();
      for (std::size_t i = 1; i < count; ++i) noun.text += " " + words[i];
      at_ += count;
      return;
    }
    failAtWord();
  }

  [[noreturn]] void failAtWord() const
  {
    const std::string shown = "\"" + oneLine(word()) + "\"";
    if (grammarWords().count(word()) != 0 || !vocabulary_.labelsMeantBy({word()}).empty())
      throw QuestionError(
          shown +
          " is not understood there; ask for example \"cup on table\" or \"nearest chair "
          "to the tv\"");
    std::string meant;
    for (const std::string& similar : vocabulary_.similarTo(word(), grammarWords()))
      meant += (meant.empty() ? "; did you mean \"" : "\" or \"") + oneLine(similar);
    throw QuestionError(
        shown + " is neither a label nor a word of questions" + meant +
        (meant.empty() ? "" : "\"?"));
  }

  std::vector<std::string> words_;
  const Vocabulary& vocabulary_;
  std::size_t at_ = 0;
  Question question_;
};

std::set<std::string> allGrammarWords()
{
  std::set<std::string> words = kSilent;
  words.insert(kAnything.begin(), kAnything.end());
  words.insert(kTowards.begin(), kTowards.end());
  const auto add = [&](const auto& phrases)
  {
    for (const Phrase& phrase : phrases)
      for (const std::string& word : wordsOf(phrase.words)) words.insert(word);
  };
  add(kRelations);
  add(kExtremes);
  return words;
}

}  // namespace

const std::set<std::string>& grammarWords()
{
  static const std::set<std::string> kWords = allGrammarWords();
  return kWords;
}

Question parseQuestion(const std::string& text, const Vocabulary& vocabulary)
{
  return Parser(wordsOf(text), vocabulary).parse();
}

}  // namespace quadmap
