#include "quadmap/relations/Questions.h"

#include <mrpt/core/format.h>

#include <algorithm>

#include "Answering.h"
#include "QuestionParser.h"
#include "Vocabulary.h"
#include "quadmap/base/ErrorText.h"

namespace quadmap
{
namespace
{
bool isNamed(const ObjectRecord& object, const Question& question)
{
  const auto names = [&](const Noun& noun) { return noun.id && *noun.id == object.id; };
  const auto namesEither = [&](const Clause& clause)
  { return names(clause.object) || (clause.second && names(*clause.second)); };
  return names(question.subject) || (question.extremeTo && names(*question.extremeTo)) ||
         std::any_of(question.clauses.begin(), question.clauses.end(), namesEither);
}

/** What a question is about: objects that are there, and those that it names by their numbers. */
Inventory askedOf(const Inventory& inventory, const Question& question)
{
  Inventory asked;
  asked.labels = inventory.labels;
  for (const InventoryItem& item : inventory.items)
    if (!item.isRefuted() || isNamed(item.record, question)) asked.items.push_back(item);
  return asked;
}

}  // namespace

Answer ask(const Inventory& inventory, const std::string& question, const AnswerLimits& limits)
{
  const Vocabulary vocabulary(inventory);
  const Question parsed = parseQuestion(question, vocabulary);
  if (parsed.extreme && !parsed.extremeTo && !limits.place)
    throw QuestionError(
        std::string("\"") + textOf(*parsed.extreme) +
        "\" to what? Ask for example \"nearest chair to the tv\", or give a place");
  const Inventory asked = askedOf(inventory, parsed);
  return Answering(asked, vocabulary, parsed, limits).answer();
}

Answer ask(const CQuadricObjectMap& map, const std::string& question, const AnswerLimits& limits)
{
  return ask(inventoryOf(map), question, limits);
}

std::string textOf(const FoundObject& found)
{
  const ObjectRecord& record = found.item.record;
  const Eigen::Vector3d c = record.object.center();
  std::string text = oneLine(record.label + " " + record.id) +
                     mrpt::format(" at (%.3f, %.3f, %.3f) m", c.x(), c.y(), c.z());
  if (found.item.isDoubtful())
    text += record.existence ? mrpt::format(", doubtful (existence %.2f)", *record.existence)
                             : std::string(", doubtful");
  for (std::size_t i = 0; i < found.reasons.size(); ++i)
    text += (i == 0 ? ": " : "; ") + found.reasons[i].text;
  return text;
}

std::vector<std::string> similarLabels(const Inventory& inventory, const std::string& word)
{
  std::string joined;
  for (const std::string& part : wordsOf(word)) joined += part;
  return Vocabulary(inventory).similarTo(joined, {});
}

}  // namespace quadmap
