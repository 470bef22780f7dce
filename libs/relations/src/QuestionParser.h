#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "Vocabulary.h"
#include "quadmap/relations/Relations.h"

namespace quadmap
{
/** Objects that a question speaks of: "the dining tables", "chair 7", "things". */
struct Noun
{
  std::string text = "object";    //!< For messages
  std::set<std::string> labels;   //!< Keys of the vocabulary; empty: any label
  std::optional<std::string> id;  //!< Only this object
};

/** "on the table"; `second` is that of "between". */
struct Clause
{
  RelationKind kind = RelationKind::On;
  Noun object;
  std::optional<Noun> second;
};

/** A question whose words are understood. */
struct Question
{
  Noun subject;
  std::vector<Clause> clauses;
  std::optional<RelationKind> extreme;  //!< Nearest or Farthest
  std::optional<Noun> extremeTo;        //!< Empty: to the place of the limits
};

/** \exception QuestionError Says what is not understood. */
Question parseQuestion(const std::string& text, const Vocabulary& vocabulary);

/** All words of questions but labels. */
const std::set<std::string>& grammarWords();

}  // namespace quadmap
