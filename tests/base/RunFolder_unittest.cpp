#include "quadmap/base/RunFolder.h"

#include <gtest/gtest.h>

#include "../obs/TemporaryFolder.h"
#include "quadmap/base/OutputFile.h"

using namespace quadmap;
namespace fs = std::filesystem;

namespace
{
/** Writes the report of a run. \return What the run warns of. */
std::string writeRun(const std::string& path, bool interrupted, const std::string& content)
{
  RunFolder folder(path, "run", "report.json", {"trajectory.tum"});
  const std::string warning = interrupted ? folder.keepCompleteResult() : "";
  const std::string state = interrupted ? "true" : "false";
  writeTextFile(
      folder.files().add("report.json"), R"({"input":{"interrupted":)" + state + "}}" + content);
  folder.files().commit();
  return warning;
}
}  // namespace

TEST(RunFolder, AnInterruptedRunLeavesACompleteResultAndGoesBeside)
{
  const TemporaryFolder folder;
  const std::string out = folder.path("out");
  writeRun(out, false, " ");
  const std::string complete = readFile(out + "/report.json");
  const std::string warning = writeRun(out, true, "");
  EXPECT_NE(warning.find(out + "/interrupted (--replace"), std::string::npos) << warning;
  EXPECT_EQ(readFile(out + "/report.json"), complete);
  EXPECT_NE(readFile(out + "/interrupted/report.json").find("true"), std::string::npos);
}

TEST(RunFolder, OnlyACompleteResultIsKept)
{
  const TemporaryFolder folder;
  const std::string out = folder.path("out"), report = out + "/report.json";
  for (const std::string earlier : {"", R"({"input":{"interrupted":true}})", "damaged", "{}"})
  {
    if (!earlier.empty()) writeTextFile(report, earlier);
    EXPECT_EQ(writeRun(out, true, " "), "") << earlier;
    EXPECT_NE(readFile(report), earlier);
    EXPECT_FALSE(fs::exists(out + "/interrupted"));
  }
}

TEST(RunFolder, AResultWhoseReportDoesNotTellIsKept)
{
  for (const std::string report : {"", "damaged", "{}", R"({"input":{"interrupted":7}})"})
  {
    const TemporaryFolder folder;
    const std::string out = folder.path("out");
    writeRun(out, false, " ");
    std::filesystem::remove(out + "/report.json");
    if (!report.empty()) writeTextFile(out + "/report.json", report);
    writeTextFile(out + "/trajectory.tum", "complete");
    const std::string warning = writeRun(out, true, "");
    EXPECT_NE(warning.find("report.json does not tell"), std::string::npos) << warning;
    EXPECT_EQ(report.empty() ? "" : readFile(out + "/report.json"), report);
    EXPECT_EQ(readFile(out + "/trajectory.tum"), "complete");
    EXPECT_TRUE(fs::exists(out + "/interrupted/report.json"));
  }
}

TEST(RunFolder, ARunThatFailsLeavesNoFolder)
{
  const TemporaryFolder folder;
  {
    const RunFolder run(folder.path("a/b"), "run", "report.json", {});
    EXPECT_TRUE(fs::is_directory(folder.path("a/b")));
    EXPECT_NE(
        errorOf([&] { RunFolder(folder.path("a/b"), "run", "report.json", {}); })
            .find("another program"),
        std::string::npos);
  }
  EXPECT_EQ(folder.fileCount(), 0u);
}
