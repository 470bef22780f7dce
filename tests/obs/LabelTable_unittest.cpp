#include "quadmap/obs/LabelTable.h"

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <set>

#include "TemporaryFolder.h"
#include "TestData.h"
#include "quadmap/base/ShareFiles.h"

using namespace quadmap;

namespace
{
/** Canonical name and darknet's spelling of COCO's 80 classes, in COCO's order. */
const std::vector<std::pair<std::string, std::string>> kCoco = {
    {        "person",         "person"},
    {       "bicycle",        "bicycle"},
    {           "car",            "car"},
    {    "motorcycle",      "motorbike"},
    {      "airplane",      "aeroplane"},
    {           "bus",            "bus"},
    {         "train",          "train"},
    {         "truck",          "truck"},
    {          "boat",           "boat"},
    { "traffic light",  "traffic_light"},
    {  "fire hydrant",   "fire_hydrant"},
    {     "stop sign",      "stop_sign"},
    { "parking meter",  "parking_meter"},
    {         "bench",          "bench"},
    {          "bird",           "bird"},
    {           "cat",            "cat"},
    {           "dog",            "dog"},
    {         "horse",          "horse"},
    {         "sheep",          "sheep"},
    {           "cow",            "cow"},
    {      "elephant",       "elephant"},
    {          "bear",           "bear"},
    {         "zebra",          "zebra"},
    {       "giraffe",        "giraffe"},
    {      "backpack",       "backpack"},
    {      "umbrella",       "umbrella"},
    {       "handbag",        "handbag"},
    {           "tie",            "tie"},
    {      "suitcase",       "suitcase"},
    {       "frisbee",        "frisbee"},
    {          "skis",           "skis"},
    {     "snowboard",      "snowboard"},
    {   "sports ball",    "sports_ball"},
    {          "kite",           "kite"},
    {  "baseball bat",   "baseball_bat"},
    {"baseball glove", "baseball_glove"},
    {    "skateboard",     "skateboard"},
    {     "surfboard",      "surfboard"},
    { "tennis racket",  "tennis_racket"},
    {        "bottle",         "bottle"},
    {    "wine glass",     "wine_glass"},
    {           "cup",            "cup"},
    {          "fork",           "fork"},
    {         "knife",          "knife"},
    {         "spoon",          "spoon"},
    {          "bowl",           "bowl"},
    {        "banana",         "banana"},
    {         "apple",          "apple"},
    {      "sandwich",       "sandwich"},
    {        "orange",         "orange"},
    {      "broccoli",       "broccoli"},
    {        "carrot",         "carrot"},
    {       "hot dog",        "hot_dog"},
    {         "pizza",          "pizza"},
    {         "donut",          "donut"},
    {          "cake",           "cake"},
    {         "chair",          "chair"},
    {         "couch",           "sofa"},
    {  "potted plant",    "pottedplant"},
    {           "bed",            "bed"},
    {  "dining table",    "diningtable"},
    {        "toilet",         "toilet"},
    {            "tv",      "tvmonitor"},
    {        "laptop",         "laptop"},
    {         "mouse",          "mouse"},
    {        "remote",         "remote"},
    {      "keyboard",       "keyboard"},
    {    "cell phone",     "cell_phone"},
    {     "microwave",      "microwave"},
    {          "oven",           "oven"},
    {       "toaster",        "toaster"},
    {          "sink",           "sink"},
    {  "refrigerator",   "refrigerator"},
    {          "book",           "book"},
    {         "clock",          "clock"},
    {          "vase",           "vase"},
    {      "scissors",       "scissors"},
    {    "teddy bear",     "teddy_bear"},
    {    "hair drier",     "hair_drier"},
    {    "toothbrush",     "toothbrush"}
};

constexpr const char* kMinimal = "[cup]\ntypicalSize = 0.1 0.1 0.1\n";

LabelTable tableOf(const std::string& text)
{
  const TemporaryFolder folder;
  return LabelTable::fromFile(folder.write("labels.ini", text));
}
}  // namespace

TEST(LabelTable, KnowsCocosClassesUnderBothSpellings)
{
  const auto table = LabelTable::installed();
  ASSERT_EQ(kCoco.size(), 80u);
  for (const auto& [name, darknet] : kCoco)
  {
    EXPECT_TRUE(table.properties(name).known) << name;
    EXPECT_EQ(table.canonical(name), name);
    EXPECT_EQ(table.canonical(darknet), name);
    EXPECT_EQ(table.properties(darknet).name, name);
  }
}

TEST(LabelTable, SpellingDetailsPlayNoPart)
{
  const auto table = LabelTable::installed();
  for (const char* spelling :
       {"dining table", "diningtable", "diningtable_", "Dining_Table", "dining-table",
        " DINING TABLE ", "diningtable2", "dining_table_12"})
    EXPECT_EQ(table.canonical(spelling), "dining table") << spelling;
  for (const char* spelling : {"tv", "TV", "tvmonitor", "TVmonitor", "television", "tv_3"})
    EXPECT_EQ(table.canonical(spelling), "tv") << spelling;
}

TEST(LabelTable, ValuesAreSensibleForARoboticist)
{
  const auto table = LabelTable::installed();
  for (const auto& [name, p] : table.all())
  {
    EXPECT_EQ(name, p.name);
    EXPECT_TRUE(p.known) << name;
    EXPECT_GE(p.shapeExponent, 1.0) << name;
    EXPECT_LE(p.shapeExponent, 2.0) << name;
    EXPECT_GT(p.typicalSize.minCoeff(), 0.005) << name << ": thinner than 5 mm";
    EXPECT_GE(p.sizeSpread, 0.1) << name;
    EXPECT_LE(p.sizeSpread, 1.0) << name;
    EXPECT_EQ(std::count(p.confusedWith.begin(), p.confusedWith.end(), name), 0) << name;
    EXPECT_TRUE(p.dominantDirection || p.support != UsualSupport::Wall)
        << name << " is flat, and faces as its wall does";
  }
  for (const char* boxy :
       {"suitcase", "refrigerator", "microwave", "tv", "book", "laptop", "bed", "cabinet",
        "dining table", "oven", "keyboard", "couch", "chair"})
  {
    EXPECT_LE(table.properties(boxy).shapeExponent, 1.2) << boxy;
    EXPECT_TRUE(table.properties(boxy).dominantDirection) << boxy;
  }
  for (const char* round :
       {"cup", "bowl", "vase", "bottle", "wine glass", "potted plant", "sports ball", "apple",
        "orange", "umbrella", "teddy bear", "cat", "dog", "person"})
  {
    EXPECT_GE(table.properties(round).shapeExponent, 1.3) << round;
    EXPECT_FALSE(table.properties(round).dominantDirection) << round;
  }
  EXPECT_TRUE(table.properties("dining table").levelTop);
  for (const char* withBack : {"chair", "couch", "bed", "bench", "laptop", "bookshelf"})
    EXPECT_FALSE(table.properties(withBack).levelTop) << withBack;
  EXPECT_EQ(table.properties("chair").support, UsualSupport::Floor);
  EXPECT_EQ(table.properties("cup").support, UsualSupport::Object);
  EXPECT_EQ(table.properties("clock").support, UsualSupport::Wall);
  EXPECT_EQ(table.properties("potted plant").support, UsualSupport::Any);
  EXPECT_NEAR(table.properties("cup").typicalSize.z(), 0.1, 0.03);
  EXPECT_GE(table.properties("suitcase").sizeSpread, 0.6) << "cabinets are called so, too";
}

TEST(LabelTable, CompatibleIsSymmetricReflexiveAndKnowsUsualConfusions)
{
  const auto table = LabelTable::installed();
  const std::vector<std::pair<std::string, std::string>> confused = {
      {        "sofa",        "chair"},
      {       "couch",        "bench"},
      {       "couch",          "bed"},
      {   "tvmonitor",       "laptop"},
      {          "tv",      "monitor"},
      {          "tv",    "microwave"},
      {          "tv", "refrigerator"},
      {         "cup",         "bowl"},
      {         "cup",         "vase"},
      {         "cup",       "bottle"},
      {         "cup",    "wineglass"},
      { "diningtable",        "bench"},
      {"dining table",          "bed"},
      {        "book",       "laptop"},
      {        "book",   "cell phone"},
      {        "book",       "remote"},
      {       "mouse",       "remote"},
      {       "mouse",   "cell_phone"},
      {    "suitcase",      "cabinet"},
      {        "sofa",        "couch"},
      {"dining table",         "sofa"}
  };
  for (const auto& [a, b] : confused)
  {
    EXPECT_TRUE(table.compatible(a, b)) << a << " " << b;
    EXPECT_TRUE(table.compatible(b, a)) << b << " " << a;
  }
  for (const auto& [a, b] : std::vector<std::pair<std::string, std::string>>{
           {"chair", "dining table"},
           {  "cup", "dining table"},
           {   "tv",        "chair"},
           {  "cup",         "book"}
  })
  {
    EXPECT_FALSE(table.compatible(a, b)) << a << " " << b;
    EXPECT_FALSE(table.compatible(b, a)) << b << " " << a;
  }
}

TEST(LabelTable, UnknownLabelsStayAsTheyAreAndAreNeutral)
{
  const auto table = LabelTable::installed();
  EXPECT_EQ(table.canonical("Flux_Capacitor 7"), "Flux_Capacitor 7");
  const auto p = table.properties("Flux_Capacitor 7");
  EXPECT_FALSE(p.known);
  EXPECT_EQ(p.name, "Flux_Capacitor 7");
  EXPECT_EQ(p.shapeExponent, LabelProperties().shapeExponent);
  EXPECT_EQ(p.support, UsualSupport::Any);
  EXPECT_TRUE(table.compatible("flux capacitor", "Flux_Capacitor"));
  EXPECT_FALSE(table.compatible("flux capacitor", "chair"));
  EXPECT_FALSE(table.compatible("", "chair"));
  EXPECT_EQ(LabelTable().canonical("chair"), "chair") << "an empty table knows nothing";
}

TEST(LabelTable, ReadsEveryKey)
{
  const auto table = tableOf(
      "[tea cup]\naliases = mug, Cha Wan\nshapeExponent = 1.75\ndominantDirection = no\n"
      "levelTop = yes\nsupport = object\ntypicalSize = 0.1 0.2, 0.3\nsizeSpread = "
      "0.4\nconfusedWith = pot\n"
      "[pot]\ntypicalSize = 1 1 1\n");
  const auto p = table.properties("chawan");
  EXPECT_EQ(p.name, "tea cup");
  EXPECT_EQ(p.shapeExponent, 1.75);
  EXPECT_FALSE(p.dominantDirection);
  EXPECT_TRUE(p.levelTop);
  EXPECT_EQ(p.support, UsualSupport::Object);
  EXPECT_EQ(p.typicalSize, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(p.sizeSpread, 0.4);
  EXPECT_EQ(p.confusedWith, std::vector<std::string>{"pot"});
  EXPECT_TRUE(table.compatible("pot", "mug"));
}

TEST(LabelTable, ErrorsNameFileSectionAndKey)
{
  const std::string good = kMinimal;
  const std::vector<std::pair<std::string, std::string>> cases = {
      {                                                "",                  "no label"},
      {                                         "[cup]\n",         "[cup] typicalSize"},
      {                  "[cup]\ntypicalSize = 0.1 0.1\n",     "[cup] typicalSize=0.1"},
      {                "[cup]\ntypicalSize = 0.1 0.1 0\n",         "[cup] typicalSize"},
      {                "[cup]\ntypicalSize = 0.1 0.1 x\n",         "[cup] typicalSize"},
      {              "[cup]\ntypicalSize = 0.1 0.1 nan\n",         "[cup] typicalSize"},
      {                    good + "shapeExponent = 2.5\n",   "[cup] shapeExponent=2.5"},
      {                  good + "shapeExponent = round\n", "[cup] shapeExponent=round"},
      {              good + "dominantDirection = maybe\n",   "[cup] dominantDirection"},
      {                         good + "levelTop = 2 m\n",            "[cup] levelTop"},
      {                      good + "support = ceiling\n",     "[cup] support=ceiling"},
      {                        good + "sizeSpread = -1\n",       "[cup] sizeSpread=-1"},
      {                       good + "shapeExponnt = 1\n",         "[cup] unknown key"},
      {                  good + "confusedWith = saucer\n",       "no label \"saucer\""},
      {good + "[mug]\naliases = Cup\ntypicalSize=1 1 1\n",  "already belongs to [cup]"},
      {                     good + "[mug]\ntypicalSize\n",              ":4: expected"},
  };
  for (const auto& [text, expected] : cases)
  {
    const auto error = errorOf([&, t = text] { tableOf(t); });
    EXPECT_NE(error.find("labels.ini"), std::string::npos) << text << error;
    EXPECT_NE(error.find(expected), std::string::npos) << text << error;
  }
  EXPECT_NE(
      errorOf([] { LabelTable::fromFile("/none/labels.ini"); }).find("/none/labels.ini"),
      std::string::npos);
}

TEST(LabelTable, RoundTripsThroughAnArchive)
{
  const auto table = LabelTable::installed();
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  table.writeTo(archive);
  stream.Seek(0);
  const auto copy = LabelTable::readFrom(archive);
  ASSERT_EQ(copy.all().size(), table.all().size());
  for (const auto& [name, a] : table.all())
  {
    const LabelProperties b = copy.properties(name);
    EXPECT_TRUE(b.known);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.shapeExponent, b.shapeExponent);
    EXPECT_EQ(a.dominantDirection, b.dominantDirection);
    EXPECT_EQ(a.levelTop, b.levelTop);
    EXPECT_EQ(a.support, b.support);
    EXPECT_EQ(a.typicalSize, b.typicalSize);
    EXPECT_EQ(a.sizeSpread, b.sizeSpread);
    EXPECT_EQ(a.confusedWith, b.confusedWith);
  }
  EXPECT_EQ(copy.canonical("TV_monitor 3"), "tv") << "aliases are kept";

  mrpt::io::CMemoryStream cut(stream.getRawBufferData(), stream.getTotalBytesCount() / 2);
  auto half = mrpt::serialization::archiveFrom(cut);
  EXPECT_ANY_THROW(LabelTable::readFrom(half));
}

TEST(LabelTable, FilesAndArchivesHaveTheSameLimits)
{
  const std::string sizes[] = {"0.01 1 100", "0.009 1 1", "1 1 101"};
  for (const auto& size : sizes)
    EXPECT_EQ(
        errorOf([&] { tableOf("[cup]\ntypicalSize = " + size + "\n"); }).empty(), &size == sizes)
        << size;

  const double allowed = 3, others[] = {0.009, 3.1, 999, -1, std::nan("")};
  const auto withSpread = [&](double spread)
  {
    mrpt::io::CMemoryStream stream;
    auto archive = mrpt::serialization::archiveFrom(stream);
    tableOf("[cup]\ntypicalSize = 1 1 1\nsizeSpread = 3\n").writeTo(archive);
    std::string bytes(
        static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount());
    const std::string stored(reinterpret_cast<const char*>(&allowed), sizeof allowed);
    const auto at = bytes.find(stored);
    EXPECT_EQ(at, bytes.rfind(stored));
    bytes.replace(at, sizeof spread, reinterpret_cast<const char*>(&spread), sizeof spread);
    mrpt::io::CMemoryStream changed(bytes.data(), bytes.size());
    auto in = mrpt::serialization::archiveFrom(changed);
    return LabelTable::readFrom(in);
  };
  EXPECT_EQ(withSpread(allowed).properties("cup").sizeSpread, allowed);
  for (const double spread : others) EXPECT_ANY_THROW(withSpread(spread)) << spread;
}

TEST(LabelTable, EveryTableThatIsReadCanBeStored)
{
  const std::string cup = "[cup]\ntypicalSize = 1 1 1\n";
  const std::string longest(1000, 'a'), tooLong(1001, 'a');
  EXPECT_EQ(errorOf([&] { tableOf(cup + "aliases = " + longest + "\n"); }), "");
  const auto error = errorOf([&] { tableOf(cup + "aliases = " + tooLong + "\n"); });
  EXPECT_NE(error.find("[cup] a label of more than 1000 bytes"), std::string::npos) << error;
  EXPECT_NE(errorOf([&] { tableOf("[" + tooLong + "]\ntypicalSize = 1 1 1\n"); }), "");
  std::string confused = "confusedWith = cup";
  for (int i = 0; i < 100; ++i) confused += ", cup";
  EXPECT_NE(errorOf([&] { tableOf(cup + confused + "\n"); }), "");
}

TEST(LabelTable, IsCompletedByClassesItDoesNotHave)
{
  const TemporaryFolder folder;
  const auto table = [&](const char* ini)
  { return LabelTable::fromFile(folder.write("t.ini", ini)); };
  const auto mine = table("[cup]\naliases = mug\ntypicalSize = 0.1 0.1 0.1\n");
  const auto other = table(
      "[cup]\ntypicalSize = 0.3 0.3 0.3\n[crane]\naliases = mug, lift\ntypicalSize = 2 2 5\n");
  const auto both = mine.completedBy(other);
  EXPECT_EQ(both.all().size(), 2u);
  EXPECT_EQ(both.properties("cup").typicalSize.x(), 0.1) << "its own class stays";
  EXPECT_EQ(both.canonical("lift"), "crane");
  EXPECT_EQ(both.canonical("mug"), "cup") << "its own spelling stays";
}

TEST(FindShareFile, TheUsersFolderComesFirstAndErrorsNameThePlaces)
{
  const TemporaryFolder folder;
  const auto mine = folder.write("labels.ini", kMinimal);
  ASSERT_EQ(::setenv("QUADMAP_SHARE_DIR", folder.folder().c_str(), 1), 0);
  EXPECT_EQ(findShareFile("labels.ini"), mine);
  EXPECT_EQ(LabelTable::installed().all().size(), 1u);
  const auto error = errorOf([] { findShareFile("nothing.ini"); });
  ASSERT_EQ(::unsetenv("QUADMAP_SHARE_DIR"), 0);

  EXPECT_NE(error.find("nothing.ini"), std::string::npos) << error;
  EXPECT_NE(error.find(folder.folder().string()), std::string::npos) << error;
  EXPECT_NE(error.find("share/quadmap"), std::string::npos) << error;
  EXPECT_NE(findShareFile("labels.ini"), mine);
}

TEST(LabelTable, KnowsAllNamesOfARealDetector)
{
  const auto path = testData("detector/coco.names");
  if (path.empty()) GTEST_SKIP() << "recordings are not here; set QUADMAP_TEST_DATA";
  const auto table = LabelTable::installed();
  std::ifstream names(path);
  unsigned count = 0;
  for (std::string name; std::getline(names, name); ++count)
    EXPECT_TRUE(table.properties(name).known) << name;
  EXPECT_EQ(count, 80u);
}
