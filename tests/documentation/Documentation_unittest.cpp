// The commands of the documentation, page by page, as a reader types them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "DocumentPage.h"
#include "Workspace.h"

using namespace quadmap;
namespace fs = std::filesystem;

namespace
{
const fs::path kSource = QUADMAP_SOURCE_DIR;

bool isRun(const CommandBlock& block) { return block.exempt.empty(); }

/** The pages that have commands to run. Those of the mathematics are formulas. */
std::vector<std::string> pages()
{
  std::vector<std::string> found{
      "README.md", "CHANGELOG.md", "rawlogs/README.md", "libs/README.md"};
  for (const char* folder : {"doc", "doc/guide"})
    for (const auto& entry : fs::directory_iterator(kSource / folder))
      if (entry.path().extension() == ".md" && entry.path().filename() != "mathematics.md")
        found.push_back(std::string(folder) + "/" + entry.path().filename().string());
  const auto isIdle = [](const std::string& page)
  {
    const auto blocks = DocumentPage(kSource / page).blocks();
    return std::none_of(blocks.begin(), blocks.end(), isRun);
  };
  found.erase(std::remove_if(found.begin(), found.end(), isIdle), found.end());
  std::sort(found.begin(), found.end());
  return found;
}

/** A result that a page shows but does not make: its commands read the folder `home`. */
bool needsHome(const std::vector<CommandBlock>& blocks)
{
  for (const auto& block : blocks)
  {
    if (!isRun(block)) continue;
    if (block.commands.find("-o home\n") != std::string::npos) return false;
    for (const char* use : {" home/", " home "})
      if (block.commands.find(use) != std::string::npos &&
          block.commands.find("simulate home") == std::string::npos)
        return true;
  }
  return false;
}

class Documentation : public ::testing::TestWithParam<std::string>
{
};

std::string testNameOf(const ::testing::TestParamInfo<std::string>& page)
{
  std::string name = page.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}
}  // namespace

TEST_P(Documentation, CommandsRun)
{
  const DocumentPage page(kSource / GetParam());
  const auto& blocks = page.blocks();
#ifndef QUADMAP_TEST_OPENNI2
  if (GetParam() == "doc/guide/use-a-camera.md") GTEST_SKIP() << "built without OpenNI2";
#endif
  const Workspace workspace;
  for (const auto& [name, content] : page.files()) workspace.folder.write(name, content);
  if (needsHome(blocks))
  {
    ASSERT_EQ(workspace.run("quadmap-slam home.rawlog -o home").status, 0);
  }
  for (const CommandBlock& block : blocks)
  {
    if (!isRun(block)) continue;
    const auto result = workspace.run(block.commands);
    ASSERT_EQ(result.status, 0) << GetParam() << ":" << block.line << ":\n"
                                << block.commands << "\n"
                                << result.out << result.err;
  }
}

INSTANTIATE_TEST_SUITE_P(Pages, Documentation, ::testing::ValuesIn(pages()), testNameOf);

TEST(DocumentedConversion, OfColmapGivesThePosesOfItsModel)
{
  const DocumentPage page(kSource / "doc/guide/coming-from.md");
  const Workspace workspace;
  const auto& blocks = page.blocks();
  const auto block = std::find_if(
      blocks.begin(), blocks.end(),
      [](const CommandBlock& b)
      { return b.commands.find("model/images.txt") != std::string::npos; });
  ASSERT_NE(block, blocks.end());
  const auto result = workspace.run(block->commands);
  ASSERT_EQ(result.status, 0) << result.err;
  const Trajectory expected =
      readTumTrajectory(workspace.folder.path("my_kitchen/groundtruth.txt"));
  const Trajectory converted = readTumTrajectory(workspace.folder.path("kitchen/groundtruth.txt"));
  ASSERT_EQ(converted.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_EQ(converted[i].time, expected[i].time);
    const auto error = expected[i].pose - converted[i].pose;  // of the one in the other
    EXPECT_LT(error.norm(), 1e-6) << "[m], the digits of the files";
    EXPECT_LT(std::abs(error.yaw()) + std::abs(error.pitch()) + std::abs(error.roll()), 1e-6);
  }
}

TEST(Demo, ShowsThatObjectsCorrectTheDrift)
{
  const Workspace workspace;
  const auto result = workspace.run("share/quadmap/examples/demo home.rawlog out");
  ASSERT_EQ(result.status, 0) << result.out << result.err;
  const auto numberAfter = [&](const std::string& text)
  {
    const auto at = result.out.find(text);
    EXPECT_NE(at, std::string::npos) << text << " is not in:\n" << result.out;
    return at == std::string::npos ? NAN : std::atof(result.out.c_str() + at + text.size());
  };
  const double before = numberAfter("the trajectory errs by "), after = numberAfter("   by ");
  EXPECT_GT(before, 0.03) << "[m], the bundled odometry drifts";
  EXPECT_LT(after, 0.5 * before);
  EXPECT_NE(result.out.find("16 of 16 objects are found"), std::string::npos) << result.out;
  for (const char* name : {"map.png", "map_top.png", "map.html", "evaluation.json", "objects.json"})
  {
    EXPECT_GT(fs::file_size(workspace.folder.path(std::string("out/") + name)), 1000u) << name;
    EXPECT_NE(result.out.find(name), std::string::npos) << "says where it is";
  }
}

TEST(DocumentPageReader, TellsCommandsFromOtherBlocks)
{
  const TemporaryFolder folder;
  const DocumentPage page(folder.write(
      "page.md",
      "text\n\n    first\n    second\n\n    third\n\n"
      "<!-- file: a.ini -->\n\n```ini\n[a]\n```\n\n```cpp\nint x;\n```\n\n"
      "<!-- not run by tests: a reason -->\n\n    fourth\n\n```bash\nfifth\n```\n\n"
      "<!-- not run by tests from here on: the rest -->\n    no block\n\n    sixth\n"));
  ASSERT_EQ(page.blocks().size(), 4u);
  EXPECT_EQ(page.blocks()[0].commands, "first\nsecond\n\nthird\n");
  EXPECT_EQ(page.blocks()[0].line, 3);
  EXPECT_EQ(page.blocks()[1].exempt, "a reason");
  EXPECT_EQ(page.blocks()[2].commands, "fifth\n");
  EXPECT_EQ(page.blocks()[2].exempt, "");
  EXPECT_EQ(page.blocks()[3].exempt, "the rest");
  EXPECT_EQ(page.files().at("a.ini"), "[a]\n");
}
