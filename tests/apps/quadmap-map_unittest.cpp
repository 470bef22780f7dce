#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "../obs/FileSizeLimit.h"
#include "RunProgram.h"
#include "SampleMap.h"
#include "quadmap/base/Sha256.h"

using namespace quadmap;

namespace
{
class QuadmapMap : public ::testing::Test
{
 protected:
  QuadmapMap() : map_(sampleMap()) { map_.saveToFile(folder_.path("objects.quadmap")); }

  /** Arguments with MAP for the file of the map and DIR for its folder. */
  ProgramResult run(const std::string& arguments) const
  {
    return runProgram(
        "quadmap-map",
        replaced(
            replaced(arguments, "MAP", "DIR/objects.quadmap"), "DIR", folder_.folder().string()));
  }

  ObjectId idOf(const std::string& label) const
  {
    const auto found = map_.withLabel(label);
    return found.empty() ? 0 : found.front()->id;
  }

  std::string option(const std::string& name, const std::string& label) const
  {
    return " --" + name + " " + std::to_string(idOf(label));
  }

  /** Labels of the answer to a query, in its order. */
  std::vector<std::string> labelsOf(const std::string& conditions) const
  {
    const auto result = run("query MAP --json " + conditions);
    std::vector<std::string> labels;
    const auto json = nlohmann::json::parse(result.out);
    for (const auto& object : json.at("objects")) labels.push_back(object.at("label"));
    EXPECT_EQ(result.status, labels.empty() ? 1 : 0) << result.err;
    return labels;
  }

  TemporaryFolder folder_;
  CQuadricObjectMap map_;
};

using Labels = std::vector<std::string>;
}  // namespace

TEST_F(QuadmapMap, InfoListsTheObjects)
{
  ASSERT_EQ(map_.confirmedObjects().size(), 3u);
  const auto result = run("info MAP");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("3 objects"), kNotFound) << result.out;
  EXPECT_NE(result.out.find("labels: 1 chair, 1 couch, 1 refrigerator"), kNotFound) << result.out;
  EXPECT_TRUE(result.err.empty());
}

TEST_F(QuadmapMap, QueryFindsByLabelPlaceAndRegion)
{
  EXPECT_EQ(labelsOf("").size(), 3u);
  EXPECT_EQ(labelsOf("--label couch"), Labels{"couch"});
  EXPECT_EQ(labelsOf("--label Sofa"), Labels{"couch"}) << "another spelling";
  EXPECT_EQ(labelsOf("--label cup"), Labels{});
  EXPECT_EQ(labelsOf("--near -1.4,0.9,0"), (Labels{"couch", "chair", "refrigerator"}));
  EXPECT_EQ(labelsOf("--near 0.5,-2,0"), (Labels{"refrigerator", "chair", "couch"}));
  EXPECT_EQ(labelsOf("--region 0,-3,0,2,0,2"), Labels{"refrigerator"});
  EXPECT_EQ(labelsOf("--region 2,0,2,0,-3,0"), Labels{"refrigerator"}) << "corners in any order";
  EXPECT_EQ(labelsOf("--region 0,-3,0,2,0,2 --label chair"), Labels{});
  EXPECT_EQ(labelsOf(option("id", "chair")), Labels{"chair"});
}

TEST_F(QuadmapMap, QueryPrintsTablesWithDistancesAndFootprints)
{
  const auto result = run("query MAP --label chair --near 1,0.5,5.45 --footprint");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("away [m]"), kNotFound) << result.out;
  EXPECT_NE(result.out.find("footprint [m]: ("), kNotFound) << result.out;
  const auto misspelt = run("query MAP --label chiar");
  EXPECT_EQ(misspelt.status, 1);
  EXPECT_NE(misspelt.err.find("\"chiar\""), kNotFound) << misspelt.err;
  EXPECT_NE(misspelt.err.find("1 chair"), kNotFound) << "what there is: " << misspelt.err;
  EXPECT_NE(misspelt.err.find("did you mean \"chair\"?"), kNotFound) << misspelt.err;
  const auto nothing = run("query MAP --label cup");
  EXPECT_EQ(nothing.status, 1) << "as grep";
  EXPECT_EQ(nothing.out, "");
  EXPECT_TRUE(isOneLine(nothing.err)) << nothing.err;
}

TEST_F(QuadmapMap, QueryAnswersQuestions)
{
  EXPECT_EQ(labelsOf("nearest thing to the sofa"), Labels{"chair"});
  EXPECT_EQ(labelsOf("'farthest object from the fridge'"), Labels{"couch"});
  EXPECT_EQ(labelsOf("chairs --region 0,-3,0,2,0,2"), Labels{});
  EXPECT_EQ(labelsOf("everything --region 0,-3,0,2,0,2"), Labels{"refrigerator"});
  EXPECT_EQ(labelsOf("nearest thing --near -1.4,0.9,0"), Labels{"couch"});
  EXPECT_EQ(labelsOf("things --near -1.4,0.9,0"), (Labels{"couch", "chair", "refrigerator"}));
  EXPECT_EQ(labelsOf("things --label chair"), Labels{"chair"});

  const auto text = run("query MAP nearest thing to the sofa --footprint");
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_EQ(text.out.find("chair " + std::to_string(idOf("chair")) + " at ("), 0u) << text.out;
  EXPECT_NE(text.out.find(" m from couch " + std::to_string(idOf("couch"))), kNotFound);
  EXPECT_NE(text.out.find("footprint [m]: ("), kNotFound);

  const auto nothing = run("query MAP cup on the couch");
  EXPECT_EQ(nothing.status, 1);
  EXPECT_EQ(nothing.out, "");
  EXPECT_NE(nothing.err.find("there is no \"cup\""), kNotFound) << nothing.err;
  const auto misspelt = run("query MAP nearest chiar to the couch");
  EXPECT_EQ(misspelt.status, 2);
  EXPECT_TRUE(isOneLine(misspelt.err)) << misspelt.err;
  EXPECT_NE(misspelt.err.find("did you mean \"chair\"?"), kNotFound) << misspelt.err;
}

TEST_F(QuadmapMap, AnswersAboutTheBundledRecording)
{
  const auto answer = [](const std::string& question)
  {
    const auto result = runProgram(
        "quadmap-map",
        "query " QUADMAP_SOURCE_DIR "/tests/maps/data/home-archive-version-0.quadmap " + question);
    EXPECT_EQ(result.status, 0) << question << result.err;
    return result.out;
  };
  const std::string table = "on dining table 5\n";
  EXPECT_NE(answer("nearest chair to the tv").find("chair 9 at "), kNotFound);
  const std::string cups = answer("cup on table");
  EXPECT_NE(cups.find("cup 4 at "), kNotFound) << cups;
  EXPECT_NE(cups.find("cup 11 at "), kNotFound) << cups;
  EXPECT_NE(cups.find(table), kNotFound) << cups;
  const std::string chairs = answer("chairs");
  EXPECT_EQ(std::count(chairs.begin(), chairs.end(), '\n'), 4);
  EXPECT_EQ(answer("books near the vase").find("book 1 at "), 0u);
  EXPECT_EQ(answer("cup between the tv and the vase").find("cup 4 at "), 0u);
  EXPECT_EQ(answer("plant next to the tv").find("potted plant 12 at "), 0u);
}

TEST_F(QuadmapMap, TakesAMapInAnyOfItsForms)
{
  writeObjectsJson(folder_.path("objects.json"), map_.toRecords());
  simpleMapOfSample().saveToFile(folder_.path("objects.simplemap"));
  for (const char* form : {"DIR", "MAP", "DIR/objects.simplemap", "DIR/objects.json"})
  {
    const auto info = run("info " + std::string(form));
    EXPECT_EQ(info.status, 0) << form << info.err;
    EXPECT_NE(info.out.find("labels: 1 chair, 1 couch, 1 refrigerator"), kNotFound) << info.out;
    const auto query = run("query " + std::string(form) + " nearest thing to the sofa");
    EXPECT_EQ(query.status, 0) << form << query.err;
    EXPECT_EQ(query.out.find("chair "), 0u) << query.out;
  }
  for (const char* form : {"DIR", "DIR/objects.simplemap"})
  {
    EXPECT_EQ(run("remove " + std::string(form) + " --id 1 -o DIR/out.quadmap").status, 0) << form;
    EXPECT_EQ(mapFrom(folder_.path("out.quadmap")).confirmedObjects().size(), 2u) << form;
  }
  const auto list = run("remove DIR/objects.json --id 1 -o DIR/x.quadmap");
  EXPECT_EQ(list.status, 1);
  EXPECT_NE(list.err.find("objects.json: is no object map"), kNotFound) << list.err;

  const TemporaryFolder empty;
  const auto none = run("info " + empty.folder().string());
  EXPECT_EQ(none.status, 1);
  EXPECT_NE(none.err.find("objects.quadmap: is missing"), kNotFound) << none.err;
  mrpt::maps::CSimpleMap withoutBoxes;
  withoutBoxes.saveToFile(empty.path("map.simplemap"));
  const auto noBoxes = run("info " + empty.path("map.simplemap"));
  EXPECT_EQ(noBoxes.status, 1);
  EXPECT_NE(noBoxes.err.find("map.simplemap: has no boxes"), kNotFound) << noBoxes.err;
}

TEST_F(QuadmapMap, RelabelRemoveAndMergeWriteANewMap)
{
  ASSERT_EQ(
      run("relabel MAP" + option("id", "chair") + " --label bench -o DIR/a.quadmap").status, 0);
  EXPECT_EQ(
      run("relabel MAP" + option("id", "chair") + " --label bnech -o DIR/x.quadmap").status, 1);
  EXPECT_EQ(
      run("relabel MAP" + option("id", "chair") + " --label anvil --any-label -o DIR/x.quadmap")
          .status,
      0);
  const auto relabelled = mapFrom(folder_.path("a.quadmap"));
  EXPECT_EQ(relabelled.withLabel("bench").size(), 1u);
  EXPECT_TRUE(relabelled.withLabel("chair").empty());

  const std::string two = option("id", "chair") + option("id", "couch");
  ASSERT_EQ(run("remove MAP" + two + " -o DIR/b.quadmap").status, 0);
  const auto removed = mapFrom(folder_.path("b.quadmap"));
  ASSERT_EQ(removed.confirmedObjects().size(), 1u);
  EXPECT_EQ(removed.confirmedObjects().front()->label(), "refrigerator");

  const std::string pair = option("keep", "couch") + option("absorb", "chair");
  ASSERT_EQ(run("merge MAP" + pair + " -o DIR/c.quadmap").status, 0);
  const auto merged = mapFrom(folder_.path("c.quadmap"));
  EXPECT_EQ(merged.objects().size(), map_.objects().size() - 1);
  EXPECT_FALSE(merged.find(idOf("chair")));

  EXPECT_EQ(mapFrom(folder_.path("objects.quadmap")).confirmedObjects().size(), 3u)
      << "the input is as it was";
}

TEST_F(QuadmapMap, AppliesAnEditList)
{
  const std::string chair = std::to_string(idOf("chair")), couch = std::to_string(idOf("couch"));
  const std::string start = R"({"format": "quadmap-edits", "version": 1, "edits": [)";
  folder_.write(
      "edits.json", start + R"({"op": "place", "id": )" + chair +
                        R"(, "center": [1, 2, 3], "size": [0.4, 0.6, 0.8], "yaw": 0.5},)" +
                        R"({"op": "remove", "id": )" + couch + "}]}");
  ASSERT_EQ(run("apply MAP DIR/edits.json -o DIR/a.quadmap").status, 0);
  const auto edited = mapFrom(folder_.path("a.quadmap"));
  EXPECT_TRUE(edited.withLabel("couch").empty());
  const MapObject* placed = edited.find(idOf("chair"));
  ASSERT_TRUE(placed);
  EXPECT_LT((placed->object.center() - Eigen::Vector3d(1, 2, 3)).norm(), 1e-6);
  EXPECT_LT((placed->object.semiAxes() - Eigen::Vector3d(0.2, 0.3, 0.4)).norm(), 1e-6);
  EXPECT_NEAR(placed->object.pose().yaw(), 0.5, 1e-6);

  const std::pair<std::string, std::string> wrong[] = {
      {                                                                                     "[]","is no list of edits"                                                                                                 },
      {                              R"({"format": "quadmap-edits", "version": 2, "edits": []})",              "is of another version"},
      {                                                  start + R"({"op": "dance", "id": 1}]})",                     "edit 1: \"op\""},
      {                                                start + R"({"op": "relabel", "id": 1}]})",                             "edit 1"},
      {                                                start + R"({"op": "remove", "id": -1}]})",                             "edit 1"},
      {                                              start + R"({"op": "remove", "id": 4711}]})", "edit 1: the map has no object 4711"},
      {   start + R"({"op": "place", "id": 1, "center": [1, 2], "size": [1, 1, 1], "yaw": 0}]})",
       "edit 1: \"center\" must have three numbers"                                                                                   },
      {start + R"({"op": "place", "id": 1, "center": [1, 2, 3], "size": [1, 0, 1], "yaw": 0}]})",
       "edit 1"                                                                                                                       }
  };
  const auto refuses = [&](const std::string& text, const std::string& expected)
  {
    folder_.write("wrong.json", text);
    const auto result = run("apply MAP DIR/wrong.json -o DIR/x.quadmap");
    EXPECT_EQ(result.status, 1) << text;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find("wrong.json: " + expected), kNotFound) << result.err;
  };
  for (const auto& [text, expected] : wrong) refuses(text, expected);
  for (const char* edit : {"{}", "7", "[]", "null", R"({"op": 3, "id": 1})"})
    refuses(start + edit + "]}", "edit 1: \"op\" is missing or of another type\n");
  refuses(
      start + R"({"op": "relabel", "id": 1, "label": 5}]})",
      "edit 1: \"label\" is missing or of another type\n");
  for (const std::string number : {"1e300", "1.5", "true", "18446744073709551615"})
    refuses(
        start + R"({"op": "remove", "id": )" + number + "}]}", "edit 1: \"id\" is no id of a map");
  const std::string place = start + R"({"op": "place", "id": )" + chair + ", ";
  refuses(
      place + R"("center": [1e300, 2, 3], "size": [1, 1, 1], "yaw": 0}]})",
      "edit 1: \"center\" is 1e+300 m away");
  refuses(
      place + R"("center": [1, 2, 3], "size": [1, 1e300, 1], "yaw": 0}]})",
      "edit 1: \"size\" is 1e+300 m, and not");
  refuses(
      place + R"("center": [1, 2, 3], "size": [1, 1, 1], "yaw": 1e300}]})",
      "edit 1: \"yaw\" is 1e+300 rad");
  EXPECT_FALSE(std::filesystem::exists(folder_.path("x.quadmap")));
}

TEST_F(QuadmapMap, AppliesAnEditListToItsOwnMapOnly)
{
  const std::string list = R"({"format": "quadmap-edits", "version": 1, "map_sha256": ")" +
                           sha256OfFile(folder_.path("objects.quadmap")) +
                           R"(", "edits": [{"op": "remove", "id": )" +
                           std::to_string(idOf("chair")) + "}]}";
  folder_.write("edits.json", list);
  ASSERT_EQ(run("apply MAP DIR/edits.json -o DIR/once.quadmap").status, 0);
  const auto other = run("apply DIR/once.quadmap DIR/edits.json -o DIR/twice.quadmap");
  EXPECT_EQ(other.status, 1);
  EXPECT_NE(other.err.find("edits.json: was made for another map"), kNotFound) << other.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.path("twice.quadmap")));
  ASSERT_EQ(
      run("relabel MAP" + option("id", "couch") + " --label bench -o DIR/o.quadmap").status, 0);
  EXPECT_EQ(run("apply DIR/o.quadmap DIR/edits.json --any-map -o DIR/p.quadmap").status, 0);
  EXPECT_TRUE(mapFrom(folder_.path("p.quadmap")).withLabel("chair").empty());
}

TEST_F(QuadmapMap, AppliesNoMisspeltLabel)
{
  folder_.write(
      "edits.json",
      R"({"format": "quadmap-edits", "version": 1, "edits": [{"op": "relabel", "id": )" +
          std::to_string(idOf("chair")) + R"(, "label": "bnech"}]})");
  const auto misspelt = run("apply MAP DIR/edits.json -o DIR/a.quadmap");
  EXPECT_EQ(misspelt.status, 1);
  EXPECT_NE(misspelt.err.find("did you mean \"bench\"?"), kNotFound) << misspelt.err;
  ASSERT_EQ(run("apply MAP DIR/edits.json --any-label -o DIR/a.quadmap").status, 0);
  EXPECT_EQ(mapFrom(folder_.path("a.quadmap")).withLabel("bnech").size(), 1u);
}

TEST_F(QuadmapMap, RefusesALabelThatNoMapCanHold)
{
  const std::string label(65537, 'x'), id = std::to_string(idOf("chair"));
  folder_.write(
      "edits.json",
      R"({"format": "quadmap-edits", "version": 1, "edits": [{"op": "relabel", "id": )" + id +
          R"(, "label": ")" + label + R"("}]})");
  for (const std::string& arguments :
       {"relabel MAP --id " + id + " --label " + label, std::string("apply MAP DIR/edits.json")})
  {
    const auto result = run(arguments + " --any-label -o DIR/x.quadmap");
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find("the label has 65537 bytes"), kNotFound) << result.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.path("x.quadmap")));
  const std::string longest(65536, 'x');
  const auto held = run("relabel MAP --id " + id + " --label " + longest + " --any-label -o MAP");
  ASSERT_EQ(held.status, 0) << held.err;
  EXPECT_EQ(mapFrom(folder_.path("objects.quadmap")).withLabel(longest).size(), 1u);
}

TEST_F(QuadmapMap, ChangesAMapInPlace)
{
  ASSERT_EQ(run("remove MAP" + option("id", "couch") + " -o MAP").status, 0);
  EXPECT_EQ(mapFrom(folder_.path("objects.quadmap")).confirmedObjects().size(), 2u);
  EXPECT_EQ(folder_.fileCount(), 1u);
}

TEST_F(QuadmapMap, FullDiskKeepsTheOldMap)
{
  const std::string before = readFile(folder_.path("objects.quadmap"));
  for (const std::size_t bytes : {before.size() / 2, before.size() - 100})
  {
    const FileSizeLimit limit(bytes);
    const auto result = run("relabel MAP" + option("id", "chair") + " --label bench -o MAP");
    EXPECT_EQ(result.status, 1) << bytes;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find("objects.quadmap: cannot be written: "), kNotFound) << result.err;
    EXPECT_TRUE(readFile(folder_.path("objects.quadmap")) == before) << bytes;
    EXPECT_EQ(folder_.fileCount(), 1u) << "no temporary file is left";
  }
}

TEST_F(QuadmapMap, NamesTheFileItCannotRead)
{
  const std::string whole = readFile(folder_.path("objects.quadmap"));
  folder_.write("short.quadmap", whole.substr(0, whole.size() / 2));
  folder_.write("empty.quadmap", "");
  folder_.write("text.quadmap", "no map at all\n");
  for (const char* name : {"short.quadmap", "empty.quadmap", "text.quadmap", "missing.quadmap"})
  {
    const auto result = run("info DIR/" + std::string(name));
    EXPECT_EQ(result.status, 1) << name;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find(folder_.path(name)), kNotFound) << result.err;
    EXPECT_TRUE(result.out.empty());
  }
}

TEST_F(QuadmapMap, NamesTheObjectThatIsNotThere)
{
  for (const char* arguments :
       {"query MAP --id 4711", "relabel MAP --id 4711 --label cup -o DIR/x",
        "remove MAP --id 4711 -o DIR/x", "merge MAP --keep 4711 --absorb 4712 -o DIR/x"})
  {
    const auto result = run(arguments);
    EXPECT_EQ(result.status, 1) << arguments;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find("no object with id 4711"), kNotFound) << result.err;
  }
  EXPECT_EQ(folder_.fileCount(), 1u) << "nothing was written";
}

TEST_F(QuadmapMap, AnIdIsNoNegativeNumber)
{
  for (const char* arguments :
       {"query MAP --id -1", "relabel MAP --id -1 --label cup -o DIR/x",
        "remove MAP --id -1 -o DIR/x", "merge MAP --keep -1 --absorb 1 -o DIR/x"})
  {
    const auto result = run(arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_NE(result.err.find(": expected a number, got '-1'"), kNotFound) << result.err;
  }
}

TEST_F(QuadmapMap, NamesTheFileItCannotWrite)
{
  const auto result =
      run("relabel MAP" + option("id", "chair") + " --label cup -o /nonexistent/out.quadmap");
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(isOneLine(result.err)) << result.err;
  EXPECT_NE(result.err.find("/nonexistent/out.quadmap"), kNotFound) << result.err;
}

TEST_F(QuadmapMap, AnswersWrongUsageWithStatus2AndOneLine)
{
  for (const char* arguments :
       {"", "dance MAP", "info", "info MAP MAP", "query MAP --near 1,2", "query MAP --near 1,2,x",
        "query MAP --near 1,2,3,4", "query MAP --near 1,2,nan", "query MAP --region 1,2,3",
        "query MAP --json --footprint", "query MAP --id one", "query MAP --lable chair",
        "relabel MAP --id 1 --label cup", "relabel MAP --id 1 -o DIR/x",
        "relabel MAP --id 1 --label '' -o DIR/x", "remove MAP -o DIR/x",
        "merge MAP --keep 1 --absorb 1 -o DIR/x"})
  {
    const auto result = run(arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_TRUE(isOneLine(result.err)) << arguments << "\n" << result.err;
    EXPECT_EQ(result.err.find("quadmap-map"), 0u) << result.err;
  }
}

TEST_F(QuadmapMap, NamesTheWrongArgumentFirst)
{
  const std::pair<const char*, const char*> complaints[] = {
      {                  "dance", "COMMAND: expected apply|info|merge|query|relabel|remove, got 'dance'"},
      {                  "qurey",                    "got 'qurey'; did you mean query? (see quadmap-map"},
      {     "info MAP -v loudly",            "--verbosity: expected debug|info|warn|error, got 'loudly'"},
      {     "query MAP --id one",                                   "--id: expected a number, got 'one'"},
      {      "query MAP --label",                                          "--label: a value is missing"},
      {"query MAP --id 1 --id 2",                                                 "--id: is given twice"},
      {    "info MAP DIR/second",                                     "second: is one argument too many"},
      {                "info ''",                 "MAP: must not be empty (see quadmap-map info --help)"},
      {   "query MAP --label ''",                                      "--label: must not be empty (see"},
      {           "query MAP ''",                                     "QUESTION: must not be empty (see"},
      {    "query MAP chairs ''",                                     "QUESTION: must not be empty (see"},
      {  "merge MAP '' -o DIR/x",                                        "OTHER: must not be empty (see"},
      {   "query MAP frobnicate",                                       "(see quadmap-map query --help)"}
  };
  for (const auto& [arguments, complaint] : complaints)
  {
    const auto result = run(arguments);
    EXPECT_NE(result.err.find(complaint), kNotFound) << arguments << "\n" << result.err;
  }
  const std::string number = runProgram("quadmap-slam", "x -o y --threads many").err;
  EXPECT_NE(number.find("--threads: expected a number, got 'many'"), kNotFound) << number;
}

TEST_F(QuadmapMap, ShowsHelpAndVersion)
{
  for (const char* arguments :
       {"--help", "info --help", "query --help", "relabel --help", "remove --help", "merge --help",
        "apply --help"})
  {
    const auto help = run(arguments);
    EXPECT_EQ(help.status, 0) << arguments;
    EXPECT_NE(help.out.find("Usage: quadmap-map "), kNotFound) << arguments;
  }
  EXPECT_EQ(run("--version").out.find("quadmap-map "), 0u);
}
