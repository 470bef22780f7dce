#include <gtest/gtest.h>
#include <mrpt/obs/CRawlog.h>

#include <cstdlib>
#include <sstream>

#include "SampleObservation.h"
#include "TemporaryFolder.h"

using namespace quadmap;

namespace
{
const std::string kPlugin = std::string(QUADMAP_LIB_DIR) + "/libquadmap-obs.so";

/** Runs a shell command. \return Its exit status. */
int run(const std::string& command) { return WEXITSTATUS(std::system(command.c_str())); }

/** The reason why Debian's program cannot be run here, or an empty text when it can. */
std::string whyNot()
{
#ifdef QUADMAP_SANITIZED
  return "a program built without sanitizers cannot load a plug-in built with them";
#else
  const bool installed = run("command -v rawlog-edit > /dev/null 2>&1") == 0;
  return installed ? "" : "rawlog-edit (Debian's mrpt-apps) is not installed";
#endif
}

std::string writeRawlog(const TemporaryFolder& folder)
{
  mrpt::obs::CRawlog rawlog;
  rawlog.insert(CObservationObjects::Create(sampleObservation()));
  auto second = sampleObservation();
  second.objects.resize(1);
  rawlog.insert(CObservationObjects::Create(second));
  const auto path = folder.path("x.objects.rawlog");
  if (!rawlog.saveToRawLogFile(path)) throw std::runtime_error("not written: " + path);
  return path;
}
}  // namespace

TEST(RawlogEdit, ExportsTheBoxesAsText)
{
  if (!whyNot().empty()) GTEST_SKIP() << whyNot();
  const TemporaryFolder folder;
  writeRawlog(folder);
  const auto log = folder.path("log");
  ASSERT_EQ(
      run("cd " + folder.folder().string() + " && rawlog-edit -p " + kPlugin +
          " -i x.objects.rawlog --export-txt > " + log + " 2>&1"),
      0)
      << readFile(log);

  std::string exported;
  for (const auto& entry : std::filesystem::directory_iterator(folder.folder()))
    if (entry.path().extension() == ".txt") exported = entry.path().string();
  ASSERT_NE(exported, "") << readFile(log);

  std::istringstream text(readFile(exported));
  std::string header, first, second, nothing;
  std::getline(text, header);
  std::getline(text, first);
  std::getline(text, second);
  std::getline(text, nothing);
  EXPECT_NE(header.find("label score x1 y1 x2 y2"), std::string::npos) << header;
  EXPECT_NE(first.find("320 240 4 dining_table 0.8750 10.500 20.250"), std::string::npos) << first;
  EXPECT_NE(first.find("cup 0.5000"), std::string::npos) << first;
  EXPECT_NE(second.find("320 240 1 dining_table"), std::string::npos) << second;
  EXPECT_EQ(nothing, "");
}

TEST(RawlogEdit, KnowsTheClassWithThePluginOnly)
{
  if (!whyNot().empty()) GTEST_SKIP() << whyNot();
  const TemporaryFolder folder;
  const auto rawlog = writeRawlog(folder);
  const auto log = folder.path("log");
  ASSERT_EQ(run("rawlog-edit -p " + kPlugin + " -i " + rawlog + " --info > " + log + " 2>&1"), 0);
  EXPECT_NE(readFile(log).find("camera"), std::string::npos) << readFile(log);
  run("rawlog-edit -i " + rawlog + " --info > " + log + " 2>&1");
  EXPECT_EQ(readFile(log).find("camera"), std::string::npos) << "a stock reader stops at the class";
}
