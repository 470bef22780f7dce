#pragma once

#include <Eigen/Dense>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "quadmap/relations/Relations.h"

namespace quadmap
{
/** A question that is not understood. The message says which word, and the nearest known ones. */
struct QuestionError : std::invalid_argument
{
  using std::invalid_argument::invalid_argument;
};

/** Why an object is an answer. */
struct Reason
{
  RelationKind kind = RelationKind::On;
  /** The ids of the objects that it has this relation to: two for between, none when `distance` is
   *  that from the place of AnswerLimits. */
  std::vector<std::string> objects;
  double distance = 0;  //!< As for Relation, of between how much longer the way by it is [m]
  std::string text;     //!< "on dining table 10"
};

/** An object that answers a question. */
struct FoundObject
{
  InventoryItem item;
  std::vector<Reason> reasons;  //!< One for each relation of the question, in its order
};

struct Answer
{
  /** Doubtful objects last, else the smallest distance of the first reason first, else by id. */
  std::vector<FoundObject> found;
  std::string whyNothing;  //!< One sentence; empty when something was found
};

/** What else than the question says which objects are asked for. */
struct AnswerLimits
{
  std::function<bool(const ObjectRecord&)> accepts;  //!< All when it is empty
  /** What "nearest" and "farthest" without "to" refer to, in the map frame [m]. Without these words
   *  the answers come in the order of their distance from it, which is their first reason. */
  std::optional<Eigen::Vector3d> place;
};

/** Answers a question in a few words of English:
 *
 *   chairs                            the objects of a label, in any of its spellings
 *   chair 7, object 7                 by id
 *   nearest chair to the tv           also closest, farthest
 *   cup on table                      also in, under, next to, near, in front of, behind
 *   cup between the tv and the book
 *   what is on the table near the tv  several at once
 *
 * Case, articles and question words play no part. A word that ends a label means all labels that
 * end so: "table" is also a coffee table. Things are on what carries them, however many lie
 * between. Doubtful objects are what the question refers to only when there are no others.
 * \exception QuestionError For an empty question, for words that are not understood, and when it
 * compares so many objects that it would take minutes. */
Answer ask(
    const Inventory& inventory, const std::string& question, const AnswerLimits& limits = {});
Answer ask(
    const CQuadricObjectMap& map, const std::string& question, const AnswerLimits& limits = {});

/** One line for people: label, id and centre, doubts, reasons. */
std::string textOf(const FoundObject& found);

/** The labels that are spelt most like a word that is none: those of the objects, and spellings of
 * the label table; at most three, best first. */
std::vector<std::string> similarLabels(const Inventory& inventory, const std::string& word);

}  // namespace quadmap
