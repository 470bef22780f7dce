#include <gtest/gtest.h>

#include <filesystem>

#include "RunProgram.h"
#include "SampleMap.h"
#include "quadmap/obs/ObjectList.h"

using namespace quadmap;

/** A person edits a page in a browser; the edits go into the map, and what the page saves as the
 * truth is what the map then says. */
TEST(PageEdits, ComeBackIntoTheMap)
{
  if (!std::filesystem::exists("/usr/share/javascript/three/three.min.js"))
    GTEST_SKIP() << "libjs-three is not installed";
  const TemporaryFolder folder;
  const std::string map = folder.path("objects.quadmap"), page = folder.path("page.html");
  sampleMap().saveToFile(map);
  ASSERT_EQ(runProgram("quadmap-export", map + " --html " + page).status, 0);
  const auto edited =
      runCommand("python3 " QUADMAP_SOURCE_DIR "/tests/review/page/check_page.py edits " + page);
  if (edited.status == 77 || edited.status == 127)
    GTEST_SKIP() << "chromium or python3 is not installed";
  ASSERT_EQ(edited.status, 0) << edited.err;

  const auto applied = runProgram(
      "quadmap-map",
      "apply " + map + " " + folder.path("edits.json") + " -o " + folder.path("out.quadmap"));
  ASSERT_EQ(applied.status, 0) << applied.err;
  const auto records = mapFrom(folder.path("out.quadmap")).toRecords();
  const auto truth = readObjectsJson(folder.path("objects.gt.json"));
  ASSERT_EQ(records.size(), truth.size());
  for (std::size_t i = 0; i < records.size(); ++i)
  {
    EXPECT_EQ(records[i].id, truth[i].id);
    EXPECT_EQ(records[i].label, truth[i].label);
    // The first one was labelled anew, which estimates it anew.
    const double tolerance = records[i].label == "bench" ? 0.02 : 2e-4;  // [m]; a page has 0.1 mm
    EXPECT_LT((records[i].object.center() - truth[i].object.center()).norm(), tolerance);
    EXPECT_LT((records[i].object.semiAxes() - truth[i].object.semiAxes()).norm(), tolerance);
  }
}
