#include "model/DetectorModel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "../obs/TemporaryFolder.h"
#include "model/ModelFolder.h"
#include "quadmap/base/ShareFiles.h"
#include "quadmap/detection/KnownDetectors.h"
#include "quadmap/folders/ClassNames.h"
#include "quadmap/obs/LabelTable.h"

using namespace quadmap;

namespace
{
/** Sets a variable of the environment for the life of this object. */
class Variable
{
 public:
  Variable(const char* name, const std::string& value) : name_(name)
  {
    if (const char* old = std::getenv(name)) old_ = old;
    ::setenv(name, value.c_str(), 1);
  }
  ~Variable() { old_.empty() ? ::unsetenv(name_) : ::setenv(name_, old_.c_str(), 1); }

 private:
  const char* name_;
  std::string old_;
};

std::string messageFor(const std::string& ini)
{
  const TemporaryFolder folder;
  const std::string path = folder.write("m.ini", ini);
  try
  {
    DetectorModel::fromFile(path);
  }
  catch (const std::exception& e)
  {
    EXPECT_EQ(std::string(e.what()).find(path), 0u) << e.what();
    return e.what();
  }
  return "no error";
}
}  // namespace

TEST(DetectorModel, OfTheProjectAreAllRight)
{
  const Variable noModels("QUADMAP_MODELS", "/nonexistent");
  const auto files = allModelFiles();
  EXPECT_GE(files.size(), 7u);
  for (const auto& file : files)
  {
    const DetectorModel model = DetectorModel::fromFile(file);
    EXPECT_NE(model.licence, "unknown") << file;
    EXPECT_NE(model.head, HeadKind::Auto) << file;
    const bool isFree = model.licence.find("GPL") == std::string::npos;
    for (const auto& part : model.parts())
    {
      EXPECT_EQ(part.url.empty(), !isFree) << file;
      EXPECT_EQ(part.sha256.empty(), !isFree) << file;
    }
    const auto labels = findModelPart(file, model.labels);
    ASSERT_TRUE(labels) << file;
    EXPECT_EQ(readClassNames(*labels).size(), 80u);
  }
}

TEST(DetectorModel, LabelsOfCocoAreInTheLabelTable)
{
  const auto table = LabelTable::installed();
  for (const auto& label : readClassNames(findShareFile("detectors/coco.names")))
    EXPECT_TRUE(table.properties(label).known) << label;
}

TEST(DetectorModel, FilesWithMistakesAreRefused)
{
  EXPECT_EQ(messageFor("[detector]\nweights = a.onnx\n"), "no error");
  for (const char* wrong :
       {"", "[detector]\n", "[detector]\nweights = a\nhight = 3\n",
        "[detector]\nweights = a\nwidth = 0\n", "[detector]\nweights = a\nhead = yolo\n",
        "[detector]\nweights = a\nfit = left\n", "[detector]\nweights = a\nchannels = gbr\n",
        "[detector]\nweights = a\nmean = 1 2\n", "[detector]\nweights = a\ndeviation = 1 0 1\n",
        "[detector]\nweights = a\nminScore = 2\n", "[detector]\nweights = a\nmaxOverlap = -1\n",
        "[detector]\nweights = a\nweightsSha256 = 12\n", "[detector]\nweights = a\n[more]\nx = 1\n",
        "[detector]\nweights = a\nnetwork = b\nhead = yolov8\n"})
    EXPECT_NE(messageFor(wrong), "no error") << wrong;
}

TEST(KnownDetectors, TellWhatIsInstalledAndHowToGetTheRest)
{
  const TemporaryFolder folder;
  const Variable models("QUADMAP_MODELS", folder.folder().string());
  folder.write("nanodet.onnx", "x");
  folder.write("own.ini", "[detector]\nweights = it's.onnx\nlicence = mine\n");
  folder.write("wrong.ini", "[detector]\nwide = 3\n");
  const auto known = knownDetectors();
  const auto find = [&](const std::string& name)
  {
    const auto found = std::find_if(
        known.begin(), known.end(), [&](const auto& model) { return model.name == name; });
    EXPECT_NE(found, known.end()) << name;
    return *found;
  };
  EXPECT_FALSE(find("nanodet-m").installed);
  EXPECT_NE(find("nanodet-m").problem.find("nanodet.onnx: is damaged"), std::string::npos);
  EXPECT_NE(find("nanodet-m").howToGet.find("curl"), std::string::npos) << "anew";
  EXPECT_EQ(find("nanodet-m").licence, "Apache-2.0");
  const auto tiny = find("yolov3-tiny");
  EXPECT_FALSE(tiny.installed);
  for (const char* part : {"curl", "yolov3-tiny.cfg'", "yolov3-tiny.weights'", "sha256sum -c"})
    EXPECT_NE(tiny.howToGet.find(part), std::string::npos) << tiny.howToGet;
  EXPECT_EQ(find("yolov8n").howToGet.find("http"), std::string::npos) << "AGPL";
  EXPECT_FALSE(find("own").installed);
  EXPECT_NE(find("wrong").problem.find("wide"), std::string::npos);
  folder.write("it's.onnx", "x");
  const auto later = knownDetectors();
  ASSERT_EQ(later.size(), known.size());
  const auto own = std::find_if(
      later.begin(), later.end(), [](const auto& model) { return model.name == "own"; });
  EXPECT_TRUE(own->installed) << "it states no checksum";
  EXPECT_EQ(own->howToGet, "");
}

TEST(DetectorFolder, IsTheUsers)
{
  {
    const Variable models("QUADMAP_MODELS", "/a/b");
    EXPECT_EQ(detectorFolder(), "/a/b");
  }
  const Variable models("QUADMAP_MODELS", ""), home("HOME", "/h");
  {
    const Variable data("XDG_DATA_HOME", "/data");
    EXPECT_EQ(detectorFolder(), "/data/quadmap/detectors");
  }
  const Variable data("XDG_DATA_HOME", "");
  EXPECT_EQ(detectorFolder(), "/h/.local/share/quadmap/detectors");
}
