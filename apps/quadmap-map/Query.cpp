#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "Commands.h"
#include "ObjectTable.h"
#include "common/CommandLine.h"
#include "quadmap/base/ConfigCheck.h"
#include "quadmap/base/ErrorText.h"
#include "quadmap/relations/AnswerFile.h"
#include "quadmap/relations/Questions.h"

namespace quadmap
{
namespace
{
/** The arguments of the query. */
struct Cli
{
  using Text = TCLAP::ValueArg<std::string>;

  cli::CommandLine line{
      "quadmap-map query",
      "Answers a question as \"nearest chair to the tv\", \"cup on table\", \"chairs\", \"books "
      "near the laptop\" or \"cup between the tv and the keyboard\", of those objects that fulfil "
      "all conditions given. Relations are on, in, under, next to, near, in front of, behind and "
      "between. Without a question it lists the objects that fulfil all conditions. The status is "
      "1 when there are none.",
      QUADMAP_VERSION};
  TCLAP::UnlabeledValueArg<std::string> file{
      "MAP", std::string(kMapHelp) + " Or an objects.json.", true, "", "MAP", line.args()};
  TCLAP::UnlabeledMultiArg<std::string> question{
      "QUESTION", "In a few words; quotes are not needed.", false, "QUESTION", line.args()};
  cli::Example chairs{
      line, "quadmap-map query home/objects.quadmap --label chair --near 0,0,0",
      "Lists the chairs, nearest to the origin first."};
  cli::Example asked{
      line, "quadmap-map query home nearest chair to the tv", "Answers a question in words."};
  Text label{"", "label", "Only objects of this label.", false, "", "LABEL", line.args()};
  Text near{"",      "near",     "Nearest to this place first, with distances [m].", false, "",
            "x,y,z", line.args()};
  Text region{"",         "region", "Only objects whose centre lies in this box [m].",
              false,      "",       "x1,y1,z1,x2,y2,z2",
              line.args()};
  Text id{"", "id", "Only this object.", false, "", "N", line.args()};
  TCLAP::SwitchArg footprint{"", "footprint", "Show the outlines on the floor.", line.args()};
  TCLAP::SwitchArg json{"", "json", "Print in the form of objects.json.", line.args()};
};

/** "1,2,3" of an argument as numbers; `count` of them. */
std::vector<double> numbersOf(TCLAP::ValueArg<std::string>& argument, std::size_t count)
{
  std::vector<double> numbers;
  const std::string text = argument.getValue() + ",";
  for (std::size_t from = 0, to; (to = text.find(',', from)) != std::string::npos; from = to + 1)
  {
    const auto number = parseNumber(text.substr(from, to - from));
    if (number && std::isfinite(*number))
      numbers.push_back(*number);
    else
      break;
  }
  const auto commas = static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
  if (numbers.size() != count || commas != count)
    throw cli::UsageError(
        "--" + argument.getName() + ": expected " + std::to_string(count) +
        " numbers with commas between, got '" + argument.getValue() + "'");
  return numbers;
}

/** What the conditions accept, and the place that distances are from. */
AnswerLimits limitsOf(Cli& cli, const Inventory& inventory)
{
  AnswerLimits limits;
  if (cli.near.isSet())
  {
    const std::vector<double> p = numbersOf(cli.near, 3);
    limits.place = Eigen::Vector3d(p[0], p[1], p[2]);
  }
  std::optional<std::string> id, label;
  if (cli.id.isSet()) id = cli.id.getValue();
  if (cli.label.isSet()) label = inventory.labels.canonical(cli.label.getValue());
  std::optional<mrpt::math::TBoundingBox> region;
  if (cli.region.isSet())
  {
    const std::vector<double> v = numbersOf(cli.region, 6);
    region = mrpt::math::TBoundingBox::FromUnsortedPoints({v[0], v[1], v[2]}, {v[3], v[4], v[5]});
  }
  limits.accepts = [=, &inventory](const ObjectRecord& object)
  {
    const Eigen::Vector3d c = object.object.center();
    return (!id || object.id == *id) &&
           (!label || inventory.labels.canonical(object.label) == *label) &&
           (!region || region->containsPoint({c.x(), c.y(), c.z()}));
  };
  return limits;
}

/** Conditions that name what is not there are mistakes. */
void checkConditions(Cli& cli, const Inventory& inventory)
{
  const std::string& path = cli.file.getValue();
  const bool isNumber = cli.id.getValue().find_first_not_of("0123456789") == std::string::npos;
  if (cli.id.isSet() && !isNumber && !isObjectList(path))
    throw cli::UsageError("--id: expected a number, got '" + oneLine(cli.id.getValue()) + "'");
  if (cli.label.isSet()) requireLabel(inventory, cli.label.getValue(), path);
  const auto hasId = [&](const InventoryItem& item) { return item.record.id == cli.id.getValue(); };
  if (cli.id.isSet() && std::none_of(inventory.items.begin(), inventory.items.end(), hasId))
    throw std::runtime_error(path + ": has no object with id " + oneLine(cli.id.getValue()));
}

/** The confirmed objects, or the one asked for, that fulfil the conditions. */
std::vector<ObjectRow> rowsOf(Cli& cli, const Inventory& inventory, const AnswerLimits& limits)
{
  std::vector<ObjectRow> rows;
  for (const InventoryItem& item : inventory.items)
    if ((item.confirmed || cli.id.isSet()) && limits.accepts(item.record))
      rows.push_back({&item.record, std::nullopt});
  if (!limits.place) return rows;
  for (ObjectRow& row : rows) row.distance = (row.object->object.center() - *limits.place).norm();
  std::stable_sort(
      rows.begin(), rows.end(),
      [](const ObjectRow& a, const ObjectRow& b) { return *a.distance < *b.distance; });
  return rows;
}

/** \return Whether anything was found. */
bool list(Cli& cli, const Inventory& inventory, const AnswerLimits& limits)
{
  const std::vector<ObjectRow> rows = rowsOf(cli, inventory, limits);
  std::vector<ObjectRecord> records;
  for (const ObjectRow& row : rows) records.push_back(*row.object);
  if (cli.json.getValue())
    std::cout << objectsToJson(records);
  else if (!rows.empty())
    std::cout << objectTable(rows, cli.footprint.getValue());
  return !rows.empty();
}

std::string questionOf(Cli& cli)
{
  std::string question;
  for (const std::string& word : cli.question.getValue())
    question += (question.empty() ? "" : " ") + word;
  return question;
}

void printAnswer(Cli& cli, const Answer& answer)
{
  if (cli.json.getValue())
  {
    std::cout << answerToJson(answer, questionOf(cli));
    return;
  }
  for (const FoundObject& found : answer.found)
  {
    std::cout << textOf(found) << "\n";
    if (cli.footprint.getValue()) std::cout << footprintText(found.item.record.object);
  }
}

Answer answerOf(Cli& cli, const Inventory& inventory, const AnswerLimits& limits)
{
  try
  {
    return ask(inventory, questionOf(cli), limits);
  }
  catch (const QuestionError& e)
  {
    throw cli::UsageError(e.what());
  }
}

}  // namespace

void queryCommand(int argc, char** argv)
{
  Cli cli;
  if (!cli.line.parse(argc, argv)) return;
  if (cli.json.getValue() && cli.footprint.getValue())
    throw cli::UsageError("--footprint and --json: the form of objects.json has no footprints");
  const std::string& path = cli.file.getValue();
  const Inventory inventory = readInventory(path);
  const AnswerLimits limits = limitsOf(cli, inventory);
  checkConditions(cli, inventory);
  if (cli.question.isSet())
  {
    const Answer answer = answerOf(cli, inventory, limits);
    printAnswer(cli, answer);
    if (answer.found.empty()) throw std::runtime_error(path + ": " + answer.whyNothing);
  }
  else if (!list(cli, inventory, limits))
    throw std::runtime_error(path + ": no object fulfils the conditions");
}

}  // namespace quadmap
