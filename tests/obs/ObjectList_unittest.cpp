#include "quadmap/obs/ObjectList.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "TemporaryFolder.h"
#include "TestData.h"
#include "quadmap/base/Json.h"

using namespace quadmap;

namespace
{
ObjectRecord sampleRecord()
{
  ObjectRecord r;
  r.id = "17";
  r.label = "dining table";
  r.object = Ellipsoid(
      mrpt::poses::CPose3D(1.0 / 3, -2e-7, 12345.678, 0.3, -0.1, 0.05),
      Eigen::Vector3d(0.123456789012345, 0.45, 1e-3));
  r.orientationDefined = false;
  r.framesVisible = 12;
  r.observations = 34;
  r.existence = 0.987654321;
  r.firstSeen = 1600000000.25;
  r.lastSeen = 1600000044.75;
  r.labelCounts = {
      {       "bench",  2},
      {"dining table", 32}
  };
  r.covariance.emplace();
  for (int i = 0; i < 49; ++i) (*r.covariance)(i / 7, i % 7) = 1e-3 / (i + 3);
  return r;
}

/** A valid file except for one field of its object. */
std::string fileWith(const std::string& field, const std::string& value)
{
  const std::vector<std::pair<std::string, std::string>> fields = {
      {      "id",                         "1"},
      {   "label",                   "\"cup\""},
      {  "center",                   "[1,2,3]"},
      {    "size",             "[0.1,0.2,0.3]"},
      {"rotation", "[[1,0,0],[0,1,0],[0,0,1]]"},
  };
  std::string text;
  bool replaced = false;
  for (const auto& [key, standard] : fields)
  {
    const bool here = key == field;
    replaced = replaced || here;
    if (here && value.empty()) continue;  // leave it out
    text += (text.empty() ? "" : ",") + ("\"" + key + "\":") + (here ? value : standard);
  }
  if (!replaced) text += ",\"" + field + "\":" + value;
  return "{\"objects\":[{" + text + "}]}";
}

std::vector<ObjectRecord> parse(const std::string& text)
{
  const TemporaryFolder folder;
  return readObjectsJson(folder.write("gt.json", text));
}
}  // namespace

TEST(ObjectsJson, EveryFieldSurvives)
{
  const TemporaryFolder folder;
  const auto path = folder.path("objects.json");
  const auto a = sampleRecord();
  ObjectRecord b;
  b.id = "cabinet \"left\"";
  b.label = "suitcase";
  writeObjectsJson(path, {a, b});
  EXPECT_EQ(folder.fileCount(), 1u) << "no temporary file is left";

  const auto read = readObjectsJson(path);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].id, a.id);
  EXPECT_EQ(read[0].label, a.label);
  EXPECT_EQ(read[0].object.center(), a.object.center());
  EXPECT_EQ(read[0].object.semiAxes(), a.object.semiAxes());
  EXPECT_TRUE(read[0].object.rotation().isApprox(a.object.rotation(), 1e-14))
      << "made orthonormal again: rounding only";
  EXPECT_EQ(read[0].orientationDefined, a.orientationDefined);
  EXPECT_EQ(read[0].framesVisible, a.framesVisible);
  EXPECT_EQ(read[0].observations, a.observations);
  EXPECT_EQ(read[0].existence, a.existence);
  EXPECT_EQ(read[0].firstSeen, a.firstSeen);
  EXPECT_EQ(read[0].lastSeen, a.lastSeen);
  EXPECT_EQ(read[0].labelCounts, a.labelCounts);
  ASSERT_TRUE(read[0].covariance);
  EXPECT_EQ(*read[0].covariance, *a.covariance);

  EXPECT_EQ(read[1].id, b.id);
  EXPECT_TRUE(read[1].orientationDefined);
  EXPECT_FALSE(read[1].framesVisible || read[1].observations || read[1].existence);
  EXPECT_TRUE(read[1].labelCounts.empty());
  EXPECT_FALSE(read[1].covariance);
}

TEST(ObjectsJson, SaysWhatItIs)
{
  const std::string head = R"({"format":"quadmap-objects","version":1,"unit":"m","frame":"map",)"
                           "\n";
  EXPECT_EQ(objectsToJson({}).find(head), 0u) << objectsToJson({});
  EXPECT_NE(objectsToJson({}, "world").find("\"frame\":\"world\""), std::string::npos);
  EXPECT_TRUE(parse("{\"objects\":[]}").empty()) << "made by hand";
  for (const char* wrong : {"\"format\":\"quadmap-edits\"", "\"version\":2", "\"unit\":\"mm\""})
  {
    const auto error = errorOf([&] { parse(std::string("{") + wrong + ",\"objects\":[]}"); });
    const std::string key(wrong, std::string(wrong).find(':'));
    EXPECT_NE(error.find(key), std::string::npos) << wrong << " must be refused: " << error;
  }
}

TEST(ObjectsJson, TheSameObjectsGiveTheSameBytes)
{
  const TemporaryFolder folder;
  writeObjectsJson(folder.path("a.json"), {sampleRecord()});
  writeObjectsJson(folder.path("b.json"), readObjectsJson(folder.path("a.json")));
  writeObjectsJson(folder.path("c.json"), {sampleRecord()});
  EXPECT_EQ(readFile(folder.path("a.json")), readFile(folder.path("c.json")));
  writeObjectsJson(folder.path("empty.json"), {});
  EXPECT_TRUE(readObjectsJson(folder.path("empty.json")).empty());
}

TEST(ObjectsJson, IdsAreNumbersWhereTheyAreNumbers)
{
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, std::string>> cases = {
      {                   "1",                        "\"id\":1,"},
      {                   "0",                        "\"id\":0,"},
      {             "cabinet",              "\"id\":\"cabinet\","},
      {                 "007",                  "\"id\":\"007\","},
      {"12345678901234567890", "\"id\":\"12345678901234567890\","},
      {                  "-1",                   "\"id\":\"-1\","}
  };
  for (const auto& [id, written] : cases)
  {
    ObjectRecord r;
    r.id = id;
    r.label = "cup";
    writeObjectsJson(folder.path("a.json"), {r});
    EXPECT_NE(readFile(folder.path("a.json")).find(written), std::string::npos) << id;
    EXPECT_EQ(readObjectsJson(folder.path("a.json")).at(0).id, id);
  }
  EXPECT_EQ(parse(fileWith("id", "\"left cup\"")).at(0).id, "left cup");
  EXPECT_EQ(parse(fileWith("id", "-5")).at(0).id, "-5");
}

TEST(ObjectsJson, SizeIsTheFullEdgeAndRotationIsObjectToWorld)
{
  const auto r = parse(fileWith("rotation", "[[0,-1,0],[1,0,0],[0,0,1]]")).at(0);
  EXPECT_EQ(r.object.center(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(r.object.semiAxes(), Eigen::Vector3d(0.05, 0.1, 0.15));
  const Eigen::Vector3d xAxis = r.object.rotation().col(0);
  EXPECT_LT((xAxis - Eigen::Vector3d::UnitY()).norm(), 1e-15) << "row major";
}

TEST(ObjectsJson, ForeignKeysAreIgnored)
{
  EXPECT_EQ(parse(fileWith("note", "{\"by\":[\"hand\",null]}")).size(), 1u);
  EXPECT_TRUE(parse("{\"made_by\":\"someone\",\"objects\":[]}").empty());
}

TEST(ObjectsJson, ASlightlyRoundedRotationIsMadeOrthonormal)
{
  const auto r =
      parse(fileWith("rotation", "[[0.9998,0.0175,0],[-0.0175,0.9998,0],[0,0,1.0002]]")).at(0);
  const Eigen::Matrix3d R = r.object.rotation();
  EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_NEAR(R(0, 1), 0.0175, 1e-5);
}

TEST(ObjectsJson, AnUndefinedOrientationNeedsNoRotation)
{
  const auto read = parse(
      "{\"objects\":[{\"id\":1,\"label\":\"cup\",\"center\":[0,0,0],\"size\":[1,1,1],"
      "\"orientation_defined\":false}]}");
  EXPECT_EQ(read.at(0).object.rotation(), Eigen::Matrix3d::Identity());
}

TEST(ObjectsJson, ErrorsNameFileAndObject)
{
  const std::vector<std::array<std::string, 3>> cases = {
      {                 "id",                             "",            "\"id\" is missing"},
      {                 "id",                          "1.5",                  "\"id\" must"},
      {                 "id",                         "\"\"",                  "\"id\" must"},
      {                 "id",                         "null",                  "\"id\" must"},
      {              "label",                             "",         "\"label\" is missing"},
      {              "label",                            "3",               "\"label\" must"},
      {             "center",                             "",        "\"center\" is missing"},
      {             "center",                        "[1,2]",              "\"center\" must"},
      {             "center",                  "[1,2,\"3\"]",              "\"center\" must"},
      {             "center",                   "[1,2,null]",              "\"center\" must"},
      {             "center",                           "{}",              "\"center\" must"},
      {               "size",                             "",          "\"size\" is missing"},
      {               "size",                      "[1,1,0]",         "\"size\" must be > 0"},
      {               "size",                     "[1,-1,1]",         "\"size\" must be > 0"},
      {             "center",                  "[1e300,0,0]",  "\"center\" is 1e+300 m away"},
      {               "size",                  "[1,1e300,1]",    "\"size\" is 1e+300 m, and"},
      {               "size",                  "[1,1e-30,1]",     "\"size\" is 1e-30 m, and"},
      {           "rotation",                             "",      "\"rotation\" is missing"},
      {           "rotation",          "[1,0,0,0,1,0,0,0,1]",            "\"rotation\" must"},
      {           "rotation",      "[[1,0,0],[0,1,0],[0,0]]",            "\"rotation\" must"},
      {           "rotation", "[[1,0,0],[0,1,0],[0,0,1.01]]",               "not a rotation"},
      {           "rotation",   "[[1,0,0],[0,1,0],[0,0,-1]]",               "not a rotation"},
      {           "rotation",    "[[0,0,0],[0,0,0],[0,0,0]]",               "not a rotation"},
      {"orientation_defined",                            "1", "\"orientation_defined\" must"},
      {     "frames_visible",                           "-1",      "\"frames_visible\" must"},
      {       "observations",                         "1e30",        "\"observations\" must"},
      {          "existence",                      "\"yes\"",           "\"existence\" must"},
      {          "existence",                            "5",                "not in [0, 1]"},
      {          "existence",                         "-0.1",                "not in [0, 1]"},
      {               "from",                        "1e300",          "\"from\" is no time"},
      {         "first_seen",                       "-1e300",    "\"first_seen\" is no time"},
      {       "label_counts",                          "[1]",        "\"label_counts\" must"},
      {       "label_counts",                 "{\"cup\":-2}",        "\"label_counts\" must"},
      {         "covariance",                        "[[1]]",          "\"covariance\" must"}
  };
  for (const auto& [field, value, expected] : cases)
  {
    const auto text = fileWith(field, value);
    const auto error = errorOf([&] { parse(text); });
    EXPECT_NE(error.find("gt.json: object 0"), std::string::npos) << text << "\n" << error;
    EXPECT_NE(error.find(expected), std::string::npos) << text << "\n" << error;
  }
}

TEST(ObjectsJson, FilesThatAreNoObjectListAreErrors)
{
  for (const char* text :
       {"", "{", "[]", "{}", "{\"objects\":{}}", "{\"objects\":[1]}", "{\"objects\":[]} x",
        "{\"objects\":[{\"id\":1}", "\xff\xfe"})
    EXPECT_NE(errorOf([&] { parse(text); }).find("gt.json: "), std::string::npos) << text;
  EXPECT_NE(
      errorOf([] { readObjectsJson("/none/gt.json"); }).find("/none/gt.json"), std::string::npos);
  const TemporaryFolder folder;
  EXPECT_NE(errorOf([&] { readObjectsJson(folder.folder().string()); }), "") << "a directory";
}

TEST(ObjectsJson, TwoObjectsWithOneIdAreAnError)
{
  const std::string object =
      "{\"id\":4,\"label\":\"cup\",\"center\":[0,0,0],\"size\":[1,1,1],"
      "\"rotation\":[[1,0,0],[0,1,0],[0,0,1]]}";
  const auto error = errorOf([&] { parse("{\"objects\":[" + object + "," + object + "]}"); });
  EXPECT_NE(error.find("object 1 (id 4)"), std::string::npos) << error;
  EXPECT_NE(error.find("twice"), std::string::npos) << error;
}

TEST(ObjectsJson, NumbersThatDoNotExistAreNotWritten)
{
  const TemporaryFolder folder;
  auto r = sampleRecord();
  (*r.covariance)(2, 2) = NAN;
  EXPECT_NE(
      errorOf([&] { writeObjectsJson(folder.path("a.json"), {r}); }).find("covariance"),
      std::string::npos);
  r = sampleRecord();
  r.existence = NAN;
  EXPECT_NE(
      errorOf([&] { writeObjectsJson(folder.path("a.json"), {r}); }).find("existence"),
      std::string::npos);
  EXPECT_EQ(folder.fileCount(), 0u);
}

TEST(ObjectsJson, LabelsWithBrokenCharactersDoNotLoseTheFile)
{
  const TemporaryFolder folder;
  auto r = sampleRecord();
  r.label = "caf\xe9";
  writeObjectsJson(folder.path("a.json"), {r});
  EXPECT_EQ(readObjectsJson(folder.path("a.json")).at(0).label, "caf\xef\xbf\xbd");
}

TEST(ObjectsJson, ReadsTheGroundTruthOfARealRecording)
{
  const auto path = testData("tum_fr3_cabinet/objects_gt.json");
  if (path.empty()) GTEST_SKIP() << "recordings are not here; set QUADMAP_TEST_DATA";
  const auto objects = readObjectsJson(path);
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].id, "cabinet");
  EXPECT_EQ(objects[0].label, "suitcase");
  EXPECT_NEAR(objects[0].object.semiAxes().x(), 0.78043 / 2, 1e-12);
}

TEST(ObjectsJson, OfTheLargestMapAreRead)
{
  constexpr std::size_t kMostObjects = 100'000;  // in an archive
  ObjectRecord record = sampleRecord();
  record.object = Ellipsoid(mrpt::poses::CPose3D(), Eigen::Vector3d::Ones());  // a short text
  record.covariance->setOnes();
  for (int i = 0; i < 6; ++i) record.labelCounts["label " + std::to_string(i)] = 1;
  const std::string one = objectsToJson({record});
  const auto begin = one.find("{\"id\""), end = one.rfind(']');
  std::string all = one.substr(0, end);
  for (std::size_t i = 1; i < kMostObjects; ++i) all += "," + one.substr(begin, end - begin);
  const TemporaryFolder folder;
  const Json file = readJson(folder.write("objects.json", all + "]}"));
  EXPECT_EQ(file.at("objects").size(), kMostObjects);
}
