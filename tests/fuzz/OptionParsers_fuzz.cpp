#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "../obs/TemporaryFolder.h"
#include "Fuzz.h"
#include "model/ModelFolder.h"
#include "quadmap/dense/DenseOptions.h"
#include "quadmap/dense/ProposalFile.h"
#include "quadmap/maps/MapMergeFile.h"
#include "quadmap/navigation/LocalizationOptions.h"
#include "quadmap/obs/ObjectList.h"
#include "quadmap/slam/SlamConfiguration.h"

using namespace quadmap;

namespace
{
/** Damages an INI file, which is given to `read` by its path. */
template <typename F>
void fuzzIni(const std::string& valid, std::vector<std::string> words, const F& read)
{
  const TemporaryFolder folder;
  FuzzRun run;
  run.place = "a.ini";
  run.words = std::move(words);
  for (const char* word : {"[]", "= yes", "${", "@define", "$env{", "<<<", "\\\n", ";", "//"})
    run.words.emplace_back(word);
  fuzz(valid, run, [&](const std::string& text) { read(folder.write("a.ini", text)); });
}
}  // namespace

TEST(Fuzz, SlamConfiguration)
{
  fuzzIni(
      SlamConfiguration().toConfig().getContent(), {"[slam]", "[input]"},
      [](const std::string& path) { SlamConfiguration::fromFile(path).toConfig(); });
}

TEST(Fuzz, LocalizationConfiguration)
{
  fuzzIni(
      LocalizationConfiguration().documentedIni(), {"[poses]", "particles = 1e9"},
      [](const std::string& path) { LocalizationConfiguration::fromFile(path).documentedIni(); });
}

TEST(Fuzz, DenseOptions)
{
  fuzzIni(DenseOptions().documentedIni("dense"), {"[dense]", "maxRange = 6"}, readDenseOptions);
}

TEST(Fuzz, MergeOptions)
{
  fuzzIni(MapMergeOptions().documentedIni("merging"), {"[merging]"}, readMergeOptions);
}

TEST(Fuzz, DetectorModel)
{
  const std::string sum(64, 'a');
  fuzzIni(
      "[detector]\nweights = tiny.weights\nweightsUrl = https://example.org/tiny.weights\n"
      "weightsSha256 = " +
          sum +
          "\nnetwork = tiny.cfg\nlabels = coco.names\nhead = darknet\nwidth = 64\nheight = 32\n"
          "fit = stretch\npadding = 0\nchannels = bgr\nmean = 1 2 3\ndeviation = 1, 1, 255\n"
          "minScore = 0.3\nmaxOverlap = 0.5\nlicence = MIT\n",
      {"[detector]", "head = yolov8", "fit = centre", "/", "../"},
      [](const std::string& path)
      {
        const auto model = DetectorModel::fromFile(path);
        for (const auto& part : model.parts()) findModelPart(path, part.file);
        findModelPart(path, model.labels);
      });
}

TEST(Fuzz, Proposals)
{
  fuzzIni(
      "; comment\n[object 3]\n; 99 points; all sides were seen\nlabel = dining%20table\n"
      "accept = yes\ncenter = 1.5 -2 0.4\nsize = 1, 0.6, 0.8\nyaw_deg = 40.11\n"
      "orientation_defined = yes\n[object left]\nlabel = cup\ncenter = 0 0 0\nsize = 1 1 1\n",
      {"[object 4]", "%00", "%", "label = ", "size = 1 1 1"},
      [](const std::string& path)
      {
        std::vector<ObjectRecord> accepted;
        for (const auto& proposal : readProposals(path))
          if (proposal.accept) accepted.push_back(proposal.record);
        writeObjectsJson(path + ".json", accepted);  // what is read can be written, and read again
        EXPECT_EQ(readObjectsJson(path + ".json").size(), accepted.size());
      });
}
