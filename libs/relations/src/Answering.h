#pragma once

#include <optional>
#include <string>
#include <vector>

#include "Carriers.h"
#include "Geometry.h"
#include "QuestionParser.h"
#include "quadmap/relations/Questions.h"

namespace quadmap
{
/** Answers one question about an inventory, which has to outlive it. */
class Answering
{
 public:
  Answering(
      const Inventory& inventory,
      const Vocabulary& vocabulary,
      const Question& question,
      const AnswerLimits& limits);

  Answer answer();

 private:
  using Indices = std::vector<std::size_t>;

  /** An object of the inventory with why it is an answer. */
  struct Candidate
  {
    std::size_t item = 0;
    std::vector<Reason> reasons;
  };

  /** What a clause refers to. */
  struct Referents
  {
    Indices first, second;  // the second ones of "between" only
  };

  bool isMeant(const InventoryItem& item, const Noun& noun) const;
  double comparisons(const Indices& asked) const;
  Indices subjects() const;
  Indices referents(const Noun& noun) const;
  std::optional<Reason> reasonFor(
      std::size_t subject, const Clause& clause, const Referents& referents) const;
  std::optional<Reason> relationTo(
      std::size_t subject, std::size_t object, RelationKind kind) const;
  std::optional<Reason> betweenReason(std::size_t subject, const Referents& referents) const;
  std::optional<Reason> carriedReason(
      std::size_t subject, std::size_t object, RelationKind kind) const;
  std::optional<Reason> underReason(std::size_t subject, std::size_t object) const;
  std::optional<Reason> distanceReason(std::size_t subject) const;
  Reason placeReason(std::size_t subject) const;
  void addPlace(std::vector<Candidate>& candidates) const;
  void keepExtreme(std::vector<Candidate>& candidates) const;
  void sort(std::vector<Candidate>& candidates) const;
  std::string whyNothing() const;
  std::string nameOf(std::size_t item) const;
  Reason reason(RelationKind kind, const Indices& objects, double distance, std::string text) const;

  const Inventory& inventory_;
  const Vocabulary& vocabulary_;
  const Question& question_;
  const AnswerLimits& limits_;
  Geometry geometry_;
  std::vector<Referents> clauseReferents_;  // in the order of the clauses
  Indices extremeReferents_;
  std::optional<Carriers> carriers_;  // set when a clause asks for them
};

}  // namespace quadmap
