#include "Answering.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <limits>

#include "quadmap/base/ErrorText.h"

namespace quadmap
{
namespace
{
/** Pairs or triples of objects that are looked at in a few seconds. */
constexpr double kMostComparisons = 3e7;

bool isOfCarriers(const Clause& clause)
{
  return clause.kind == RelationKind::On || clause.kind == RelationKind::In ||
         clause.kind == RelationKind::Under;
}

std::string countOf(std::size_t count, const Noun& noun)
{
  return std::to_string(count) + " \"" + oneLine(noun.text) + "\"";
}

}  // namespace

Answering::Answering(
    const Inventory& inventory,
    const Vocabulary& vocabulary,
    const Question& question,
    const AnswerLimits& limits) :
    inventory_(inventory),
    vocabulary_(vocabulary),
    question_(question),
    limits_(limits),
    geometry_(inventory)
{
  for (const Clause& clause : question_.clauses)
    clauseReferents_.push_back(
        {referents(clause.object), clause.second ? referents(*clause.second) : Indices()});
  if (question_.extremeTo) extremeReferents_ = referents(*question_.extremeTo);
}

/** How many objects are compared with how many. */
double Answering::comparisons(const Indices& asked) const
{
  const double subjects = double(asked.size()), all = double(geometry_.size());
  double sum = subjects * double(extremeReferents_.size());
  for (std::size_t i = 0; i < question_.clauses.size(); ++i)
  {
    const double first = double(clauseReferents_[i].first.size());
    const double second = double(clauseReferents_[i].second.size());
    const bool isBetween = question_.clauses[i].kind == RelationKind::Between;
    sum += subjects * first * (isBetween ? second : 1.0);
    // A chain of things that carry each other may have all of them.
    if (isOfCarriers(question_.clauses[i])) sum += (all + subjects * first) * all;
  }
  return sum;
}

Answer Answering::answer()
{
  const Indices asked = subjects();
  if (comparisons(asked) > kMostComparisons)
    throw QuestionError(
        "of " + countOf(asked.size(), question_.subject) +
        " too many would be compared with others: name one by its id, or ask within limits");
  if (std::any_of(question_.clauses.begin(), question_.clauses.end(), isOfCarriers))
    carriers_.emplace(geometry_);
  std::vector<Candidate> candidates;
  for (const std::size_t subject : asked)
  {
    Candidate candidate{subject, {}};
    for (std::size_t i = 0; i < question_.clauses.size(); ++i)
      if (auto found = reasonFor(subject, question_.clauses[i], clauseReferents_[i]))
        candidate.reasons.push_back(std::move(*found));
    if (candidate.reasons.size() == question_.clauses.size()) candidates.push_back(candidate);
  }
  addPlace(candidates);
  keepExtreme(candidates);
  sort(candidates);
  Answer answer;
  for (Candidate& candidate : candidates)
    answer.found.push_back({inventory_.items[candidate.item], std::move(candidate.reasons)});
  if (answer.found.empty()) answer.whyNothing = whyNothing();
  return answer;
}

// What is spoken of ---------------------------------------------------------------------------

bool Answering::isMeant(const InventoryItem& item, const Noun& noun) const
{
  if (noun.id && *noun.id != item.record.id) return false;
  return noun.labels.empty() || noun.labels.count(vocabulary_.keyOf(item.record.label)) != 0;
}

Answering::Indices Answering::subjects() const
{
  Indices found;
  for (std::size_t i = 0; i < inventory_.items.size(); ++i)
  {
    const InventoryItem& item = inventory_.items[i];
    const bool isWithin = !limits_.accepts || limits_.accepts(item.record);
    if (isWithin && isMeant(item, question_.subject)) found.push_back(i);
  }
  return found;
}

/** The objects that a relation refers to: doubtful ones only when there are no others. */
Answering::Indices Answering::referents(const Noun& noun) const
{
  Indices certain, doubtful;
  for (std::size_t i = 0; i < inventory_.items.size(); ++i)
    if (isMeant(inventory_.items[i], noun))
      (inventory_.items[i].isDoubtful() ? doubtful : certain).push_back(i);
  return certain.empty() ? doubtful : certain;
}

std::string Answering::nameOf(std::size_t item) const
{
  const InventoryItem& named = inventory_.items[item];
  return oneLine(named.record.label + " " + named.record.id) + (named.isDoubtful() ? "?" : "");
}

// Relations -----------------------------------------------------------------------------------

Reason Answering::reason(
    RelationKind kind, const Indices& objects, double distance, std::string text) const
{
  Reason reason{kind, {}, distance, std::move(text)};
  for (const std::size_t object : objects)
    reason.objects.push_back(inventory_.items[object].record.id);
  return reason;
}

/** The relation of the clause to the object for which its distance is smallest. */
std::optional<Reason> Answering::reasonFor(
    std::size_t subject, const Clause& clause, const Referents& referents) const
{
  if (clause.kind == RelationKind::Between) return betweenReason(subject, referents);
  std::optional<Reason> best;
  for (const std::size_t object : referents.first)
  {
    auto found = relationTo(subject, object, clause.kind);
    if (found && (!best || found->distance < best->distance)) best = std::move(found);
  }
  return best;
}

std::optional<Reason> Answering::relationTo(
    std::size_t subject, std::size_t object, RelationKind kind) const
{
  if (kind == RelationKind::On || kind == RelationKind::In)
    return carriedReason(subject, object, kind);
  if (kind == RelationKind::Under) return underReason(subject, object);
  std::optional<double> distance;
  if (kind == RelationKind::NextTo) distance = geometry_.nextTo(subject, object);
  if (kind == RelationKind::Near) distance = geometry_.near(subject, object);
  if (kind == RelationKind::InFrontOf) distance = geometry_.inFrontOf(subject, object);
  if (kind == RelationKind::Behind) distance = geometry_.behind(subject, object);
  if (!distance) return std::nullopt;
  const std::string metres = mrpt::format("%.2f m", *distance), name = nameOf(object);
  std::string text = metres + " " + textOf(kind) + " " + name;
  if (kind == RelationKind::Near) text = metres + " from " + name;
  if (kind == RelationKind::NextTo)
    text = std::string(textOf(kind)) + " " + name + ", " + metres + " apart";
  return reason(kind, {object}, *distance, text);
}

std::optional<Reason> Answering::carriedReason(
    std::size_t subject, std::size_t object, RelationKind kind) const
{
  const auto way = carriers_->way(subject, object, kind);
  if (!way || subject == object) return std::nullopt;
  std::string text;
  std::size_t last = subject;
  for (const std::size_t carrier : *way)
  {
    const bool isIn = carrier == object ? kind == RelationKind::In : !geometry_.on(last, carrier);
    text += std::string(text.empty() ? "" : " ") + (isIn ? "in " : "on ") + nameOf(carrier);
    last = carrier;
  }
  return reason(kind, {object}, geometry_.gap(subject, object), text);
}

std::optional<Reason> Answering::underReason(std::size_t subject, std::size_t object) const
{
  const bool isCovered = geometry_.hasLevelTop(object) && geometry_.in(subject, object);
  if (subject == object || (!isCovered && !carriers_->way(object, subject, RelationKind::On)))
    return std::nullopt;
  return reason(
      RelationKind::Under, {object}, geometry_.gap(subject, object), "under " + nameOf(object));
}

std::optional<Reason> Answering::betweenReason(
    std::size_t subject, const Referents& referents) const
{
  std::optional<Reason> best;
  for (const std::size_t first : referents.first)
    for (const std::size_t second : referents.second)
    {
      const auto detour = geometry_.between(subject, first, second);
      if (!detour || (best && *detour >= best->distance)) continue;
      best = reason(
          RelationKind::Between, {first, second}, *detour,
          "between " + nameOf(first) + " and " + nameOf(second));
    }
  return best;
}

// Nearest and farthest ------------------------------------------------------------------------

/** How far the subject's centre is from the place of the limits. */
Reason Answering::placeReason(std::size_t subject) const
{
  const Eigen::Vector3d& p = *limits_.place;
  const double distance = (inventory_.items[subject].record.object.center() - p).norm();
  return reason(
      question_.extreme.value_or(RelationKind::Near), {}, distance,
      mrpt::format("%.2f m from (%.2f, %.2f, %.2f)", distance, p.x(), p.y(), p.z()));
}

void Answering::addPlace(std::vector<Candidate>& candidates) const
{
  if (!limits_.place || question_.extreme) return;
  for (Candidate& candidate : candidates)
    candidate.reasons.insert(candidate.reasons.begin(), placeReason(candidate.item));
}

/** From the nearest object that the question names, or from the place of the limits. */
std::optional<Reason> Answering::distanceReason(std::size_t subject) const
{
  const RelationKind kind = *question_.extreme;
  if (!question_.extremeTo) return placeReason(subject);
  std::optional<Reason> best;
  for (const std::size_t object : extremeReferents_)
  {
    if (object == subject) continue;
    const double distance = geometry_.gap(subject, object);
    if (best && distance >= best->distance) continue;
    best =
        reason(kind, {object}, distance, mrpt::format("%.2f m from ", distance) + nameOf(object));
  }
  return best;
}

/** Leaves the one nearest or farthest object, a doubtful one only when there are no others. */
void Answering::keepExtreme(std::vector<Candidate>& candidates) const
{
  if (!question_.extreme) return;
  const double sign = *question_.extreme == RelationKind::Nearest ? 1 : -1;
  std::optional<Candidate> best;
  for (Candidate& candidate : candidates)
  {
    auto distance = distanceReason(candidate.item);
    if (!distance) continue;
    candidate.reasons.insert(candidate.reasons.begin(), std::move(*distance));
    const auto rank = [&](const Candidate& c) {
      return std::pair{inventory_.items[c.item].isDoubtful(), sign * c.reasons.front().distance};
    };
    if (!best || rank(candidate) < rank(*best)) best = candidate;
  }
  candidates.clear();
  if (best) candidates.push_back(*best);
}

void Answering::sort(std::vector<Candidate>& candidates) const
{
  const auto rank = [&](const Candidate& c)
  {
    return std::pair{
        inventory_.items[c.item].isDoubtful(),
        c.reasons.empty() ? 0.0 : c.reasons.front().distance};
  };
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [&](const Candidate& a, const Candidate& b) { return rank(a) < rank(b); });
}

/** Why there is no answer: what is not there at all, or else how many were looked at. */
std::string Answering::whyNothing() const
{
  if (subjects().empty())
  {
    const bool isThere = !Answering(inventory_, vocabulary_, question_, {}).subjects().empty();
    return "there is no \"" + oneLine(question_.subject.text) + "\"" +
           (isThere ? " within the limits" : "");
  }
  std::string relations;
  const auto missing = [&](const Noun& noun) { return referents(noun).empty(); };
  for (const Clause& clause : question_.clauses)
  {
    for (const Noun* noun : {&clause.object, clause.second ? &*clause.second : nullptr})
      if (noun && missing(*noun)) return "there is no \"" + oneLine(noun->text) + "\"";
    relations +=
        std::string(relations.empty() ? "" : " and ") + textOf(clause.kind) + " " +
        (clause.second ? countOf(referents(clause.object).size(), clause.object) + " and " +
                             countOf(referents(*clause.second).size(), *clause.second)
                       : "any of " + countOf(referents(clause.object).size(), clause.object));
  }
  if (question_.extremeTo && missing(*question_.extremeTo))
    return "there is no \"" + oneLine(question_.extremeTo->text) + "\"";
  if (relations.empty()) return "there is no other \"" + oneLine(question_.subject.text) + "\"";
  return "of " + countOf(subjects().size(), question_.subject) + " none is " + relations;
}

}  // namespace quadmap
