#include "quadmap/relations/Questions.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "../maps/SyntheticScene.h"
#include "SampleInventory.h"
#include "quadmap/relations/AnswerFile.h"

using namespace quadmap;
using namespace quadmap::testing;

namespace
{
using Ids = std::vector<std::string>;

Ids idsOf(const Answer& answer)
{
  Ids ids;
  for (const FoundObject& found : answer.found) ids.push_back(found.item.record.id);
  return ids;
}

Ids asked(const std::string& question, const Inventory& inventory = livingRoom())
{
  return idsOf(ask(inventory, question));
}

std::string reasonOf(const std::string& question, const Inventory& inventory = livingRoom())
{
  const Answer answer = ask(inventory, question);
  if (answer.found.empty() || answer.found.front().reasons.empty()) return answer.whyNothing;
  return answer.found.front().reasons.front().text;
}

std::string complaintAbout(const std::string& question)
{
  try
  {
    ask(livingRoom(), question);
  }
  catch (const QuestionError& e)
  {
    return e.what();
  }
  return "none";
}
}  // namespace

TEST(Questions, FindLabelsAndIds)
{
  EXPECT_EQ(asked("cups"), (Ids{"5", "8"}));
  EXPECT_EQ(asked("Where are all the MUGS?"), (Ids{"5", "8"}));
  EXPECT_EQ(asked("cup 8"), Ids{"8"});
  EXPECT_EQ(asked("object 3"), Ids{"3"});
  EXPECT_EQ(asked("#3"), Ids{"3"});
  EXPECT_EQ(asked("cup 3"), Ids{}) << "3 is a table";
  EXPECT_EQ(asked("everything").size(), livingRoom().items.size());
  EXPECT_EQ(asked("sofa"), Ids{"4"});
}

TEST(Questions, FindTheNearestAndTheFarthest)
{
  EXPECT_EQ(asked("nearest cup to the tv"), Ids{"8"});
  EXPECT_EQ(asked("closest cup to the couch"), Ids{"5"});
  EXPECT_EQ(asked("cup nearest the couch"), Ids{"5"});
  EXPECT_EQ(asked("the cup that is farthest from the couch"), Ids{"8"});
  EXPECT_EQ(asked("what is nearest to the tv"), asked("nearest thing to the tv"));
  EXPECT_EQ(asked("what is nearest the tv"), asked("nearest thing to the tv"));
  EXPECT_EQ(asked("nearest to the tv"), asked("nearest thing to the tv"));
  EXPECT_EQ(asked("which is the nearest cup to the tv"), Ids{"8"});
  EXPECT_EQ(asked("what is the nearest cup to the tv"), Ids{"8"});
  EXPECT_EQ(
      asked("what is nearest to the tv on the table"), asked("nearest thing to the tv on table"));
  EXPECT_EQ(complaintAbout("what is the nearest tv"), complaintAbout("nearest tv"));
  EXPECT_EQ(asked("nearest cup to cup 5"), Ids{"8"}) << "it is not its own neighbour";
  // The tv ends at x = 0.5, y = 2.05, z = 0.5; the cup begins at x = 0.86, y = 2.86, z = 0.1.
  EXPECT_EQ(reasonOf("nearest cup to the tv"), "0.97 m from tv 1");
}

TEST(Questions, FindByRelations)
{
  EXPECT_EQ(asked("cup on table"), Ids{"5"});
  EXPECT_EQ(asked("what is on the coffee table"), (Ids{"6", "7", "5"}))
      << "the apple in the bowl, too";
  EXPECT_EQ(asked("apple in the bowl"), Ids{"7"});
  EXPECT_EQ(asked("apple on bowl"), Ids{});
  EXPECT_EQ(asked("suitcase under the table"), Ids{"10"});
  EXPECT_EQ(asked("what is under the cup 5"), Ids{"3"});
  EXPECT_EQ(asked("plant next to the cabinet"), Ids{"11"});
  EXPECT_EQ(asked("plant near the tv"), Ids{"11"});
  EXPECT_EQ(asked("anything in front of the couch near the bowl on the table"), (Ids{"7", "5"}));
  EXPECT_EQ(asked("table between the tv and the couch"), Ids{"3"});
  EXPECT_EQ(asked("cup behind the tv"), Ids{"8"});
}

TEST(Questions, SayWhy)
{
  const Inventory stack = inventoryWith({
      standing("1", "desk", {0, 0}, 0, {1.2, 0.6, 0.7}),
      standing("2", "box", {0, 0}, 0.7, {0.3, 0.3, 0.2}),
      standing("3", "cup", {0, 0}, 0.9, {0.1, 0.1, 0.1}),
  });
  EXPECT_EQ(reasonOf("cup on desk", stack), "on box 2 on desk 1");
  EXPECT_EQ(reasonOf("cup on table"), "on coffee table 3");
  EXPECT_EQ(reasonOf("plant next to cabinet"), "next to cabinet 2, 0.30 m apart");
  EXPECT_EQ(reasonOf("cup between the tv and the couch"), "between tv 1 and couch 4");
  EXPECT_EQ(reasonOf("couch in front of the tv"), "2.95 m in front of tv 1");
  const Answer answer = ask(livingRoom(), "cup on table");
  EXPECT_EQ(textOf(answer.found.at(0)), "cup 5 at (0.300, 0.600, 0.520) m: on coffee table 3");
}

TEST(Questions, SayWhyThereIsNothing)
{
  EXPECT_EQ(reasonOf("banana"), "there is no \"banana\"");
  EXPECT_EQ(reasonOf("cup on the bed"), "there is no \"bed\"");
  EXPECT_EQ(reasonOf("nearest cup to the bed"), "there is no \"bed\"");
  EXPECT_EQ(reasonOf("cups on the couch"), "of 2 \"cups\" none is on any of 1 \"couch\"");
  AnswerLimits limits;
  limits.accepts = [](const ObjectRecord&) { return false; };
  EXPECT_EQ(ask(livingRoom(), "cup", limits).whyNothing, "there is no \"cup\" within the limits");
}

TEST(Questions, NameTheWordThatIsNotUnderstood)
{
  EXPECT_EQ(
      complaintAbout("chiar"),
      "\"chiar\" is neither a label nor a word of questions; did you mean \"chair\"?");
  EXPECT_NE(complaintAbout("cup onn table").find("\"onn\""), std::string::npos);
  EXPECT_NE(complaintAbout("cup onn table").find("\"on\""), std::string::npos);
  EXPECT_NE(complaintAbout("cup on").find("\"on\" what?"), std::string::npos);
  EXPECT_NE(complaintAbout("").find("empty"), std::string::npos);
  EXPECT_NE(complaintAbout("where is the").find("empty"), std::string::npos);
  EXPECT_NE(complaintAbout("nearest cup").find("\"nearest\" to what?"), std::string::npos);
  EXPECT_NE(
      complaintAbout("cup table").find("\"table\" is not understood there"), std::string::npos);
  EXPECT_EQ(complaintAbout("zzzzzz"), "\"zzzzzz\" is neither a label nor a word of questions");
}

TEST(Questions, AnyWordsAreAnsweredOrRefused)
{
  const std::vector<std::string> words = {
      "cup",
      "table",
      "on",
      "in",
      "next",
      "to",
      "near",
      "between",
      "and",
      "nearest",
      "the",
      "5",
      "front",
      "of",
      "behind",
      "under",
      "things",
      "\xff\xfe",
      "99999999999999999999",
      "top",
      "?"};
  const Inventory room = livingRoom();
  std::mt19937 random(3);
  int answered = 0;
  for (int i = 0; i < 3000; ++i)
  {
    std::string question;
    for (auto n = random() % 7; n > 0; --n) question += words[random() % words.size()] + " ";
    try
    {
      const Answer answer = ask(room, question);
      EXPECT_EQ(answer.found.empty(), !answer.whyNothing.empty()) << question;
      ++answered;
    }
    catch (const QuestionError& e)
    {
      EXPECT_FALSE(std::string(e.what()).empty());
    }
  }
  EXPECT_GT(answered, 100) << "the test hardly asks anything";
}

TEST(Questions, DoubtfulObjectsComeLastAndAreMarked)
{
  Inventory room = livingRoom();
  room.items[4].record.existence = 0.42;  // the cup on the table
  room.items.push_back(standing("12", "tv", {0.9, 2.5}, 0, {0.5, 0.1, 0.4}));
  room.items.back().confirmed = false;
  EXPECT_EQ(asked("cups", room), (Ids{"8", "5"}));
  EXPECT_EQ(
      textOf(ask(room, "cups").found.at(1)),
      "cup 5 at (0.300, 0.600, 0.520) m, doubtful (existence 0.42)");
  EXPECT_EQ(asked("nearest cup to the couch", room), Ids{"8"}) << "a certain one is there";
  EXPECT_EQ(reasonOf("nearest cup to the tv", room), "0.97 m from tv 1") << "not from tv 12";
  EXPECT_EQ(asked("cup on table", room), Ids{"5"}) << "better than nothing";
  room.items[0].confirmed = false;
  EXPECT_EQ(reasonOf("nearest cup to the tv", room), "0.31 m from tv 12?") << "no other is left";
}

TEST(Questions, DoNotFindWhatIsSurelyNotThere)
{
  Inventory room = livingRoom();
  for (InventoryItem& item : room.items)
    if (item.record.id == "1" || item.record.id == "5")
    {
      item.confirmed = false;
      item.record.existence = 0.09;
    }
  EXPECT_EQ(asked("cups", room), Ids{"8"});
  EXPECT_EQ(ask(room, "cup near the tv").whyNothing, "there is no \"tv\"");
  EXPECT_EQ(asked("cup 5", room), Ids{"5"}) << "by its number it is";
  EXPECT_EQ(asked("cup 5 near tv 1", room), asked("cup 5 near tv 1", livingRoom()));
}

TEST(Questions, KeepWithinLimits)
{
  AnswerLimits limits;
  limits.accepts = [](const ObjectRecord& object) { return object.object.center().y() < 1; };
  EXPECT_EQ(idsOf(ask(livingRoom(), "nearest cup to the tv", limits)), Ids{"5"});
  limits.accepts = {};
  limits.place = Eigen::Vector3d(0.9, 3, 0);
  EXPECT_EQ(idsOf(ask(livingRoom(), "nearest cup", limits)), Ids{"8"});
  EXPECT_EQ(idsOf(ask(livingRoom(), "farthest cup", limits)), Ids{"5"});
  const Answer sorted = ask(livingRoom(), "cups", limits);
  EXPECT_EQ(idsOf(sorted), (Ids{"8", "5"}));
  EXPECT_EQ(sorted.found.at(0).reasons.at(0).text, "0.11 m from (0.90, 3.00, 0.00)");
}

TEST(Questions, AnswerAsJson)
{
  const std::string question = "cup on \"table\"";
  const auto json = nlohmann::json::parse(answerToJson(ask(livingRoom(), question), question));
  EXPECT_EQ(json.at("question"), question);
  const auto& cup = json.at("objects").at(0);
  EXPECT_EQ(cup.at("id"), 5);
  EXPECT_EQ(cup.at("label"), "cup");
  EXPECT_DOUBLE_EQ(cup.at("center").at(0), 0.3);
  EXPECT_EQ(cup.at("doubtful"), false);
  EXPECT_EQ(cup.at("reasons").at(0).at("relation"), "on");
  EXPECT_EQ(cup.at("reasons").at(0).at("to"), nlohmann::json::array({3}));
  EXPECT_NEAR(cup.at("reasons").at(0).at("distance_m"), 0.02, 1e-9);
  EXPECT_TRUE(nlohmann::json::parse(answerToJson({}, "x")).at("objects").empty());
}

TEST(Questions, AskAMapItself)
{
  CQuadricObjectMap map;
  const auto add = [&](const std::string& label, const Eigen::Vector3d& center,
                       const Eigen::Vector3d& size, double logOdds)
  {
    MapObject object;
    object.object = cuboid(label, center, size, 0).object;
    object.labelCounts[label] = 9;
    object.completeCount = 9;
    object.covariance *= 1e-4;
    object.existenceLogOdds = logOdds;
    return map.addObject(object);
  };
  const ObjectId table = add("dining table", {0, 0, 0.4}, {1.4, 0.9, 0.8}, 8);
  const ObjectId cup = add("cup", {0.2, 0.1, 0.86}, {0.1, 0.1, 0.12}, 8);
  const ObjectId phantom = add("cup", {0.4, 0.1, 0.86}, {0.1, 0.1, 0.12}, -1);
  EXPECT_EQ(
      idsOf(ask(map, "cups on the table")), (Ids{std::to_string(cup), std::to_string(phantom)}));
  EXPECT_TRUE(ask(map, "cups on the table").found.at(1).item.isDoubtful());
  const auto relations = relationsOf(map);
  ASSERT_FALSE(relations.empty());
  const auto isCupOnTable = [&](const Relation& r)
  {
    return r.kind == RelationKind::On && r.subject == std::to_string(cup) &&
           r.object == std::to_string(table);
  };
  EXPECT_EQ(std::count_if(relations.begin(), relations.end(), isCupOnTable), 1);
}

TEST(Questions, AboutThousandsOfThingsAreAnsweredAtOnceOrNotAtAll)
{
  Inventory hall;
  while (hall.items.size() < 1000)
  {
    InventoryItem chair = livingRoom().items.front();
    chair.record.id = std::to_string(hall.items.size());
    chair.record.label = "chair";
    hall.items.push_back(chair);
  }
  EXPECT_EQ(ask(hall, "chairs").found.size(), 1000U);
  EXPECT_FALSE(ask(hall, "chairs near chair 7").found.empty());
  const auto complaint = [&](const std::string& question)
  {
    try
    {
      return std::to_string(ask(hall, question).found.size());
    }
    catch (const QuestionError& e)
    {
      return std::string(e.what());
    }
  };
  EXPECT_EQ(
      complaint("chairs between the chairs"),
      "of 1000 \"chairs\" too many would be compared with others: name one by its id, or ask "
      "within limits");
  EXPECT_NE(complaint("chairs on the chairs").find("too many"), std::string::npos);
  EXPECT_EQ(complaint("chairs between the chairs and chair 7").find("too many"), std::string::npos)
      << "a million triples";
}
