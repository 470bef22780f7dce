#include "quadmap/base/InputFile.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "../obs/TemporaryFolder.h"
#include "quadmap/base/ConfigCheck.h"
#include "quadmap/base/GzipInput.h"
#include "quadmap/base/Json.h"
#include "quadmap/base/Sha256.h"
#include "quadmap/obs/Trajectory.h"

using namespace quadmap;

TEST(OpenModestText, NamesFileAndSize)
{
  const TemporaryFolder folder;
  const auto path = folder.write("x.ini", std::string(3u << 20, '#'));
  EXPECT_EQ(
      errorOf([&] { openModestText(path); }),
      path + ": has 3.0 MB, more than the 1 MB that such a file may have");
  EXPECT_EQ(errorOf([&] { EXPECT_EQ(openModestText(path, 3u << 20).peek(), '#'); }), "");
  EXPECT_EQ(
      errorOf([] { openModestText("/nowhere/x.ini"); }),
      "/nowhere/x.ini: cannot be read: No such file or directory");
  EXPECT_EQ(
      errorOf([&] { openModestText(folder.path("")); }),
      folder.path("") + ": is a directory, not a file");
}

TEST(WarningOfCut, IsForTextsThatEndWithinALine)
{
  const TemporaryFolder folder;
  const auto warningFor = [&](const std::string& text)
  { return warningOfCut(folder.write("x.tum", text)); };
  for (const char* whole : {"", "\n", "1 2\n", "1 2\r\n"})
    EXPECT_EQ(warningFor(whole), "") << whole;
  for (const char* cut : {"1", "1 2\n3"})
    EXPECT_EQ(warningFor(cut), "ends without a line break: its last line may be cut off") << cut;
  EXPECT_EQ(warningOfCut(folder.path("missing.tum")), "");
}

TEST(InputFile, NoReaderWaitsAtAPipeOrReadsADevice)
{
  const std::vector<std::function<void(const std::string&)>> readers = {
      [](const std::string& path) { requireNoDevice(path); },
      [](const std::string& path) { openModestText(path); },
      [](const std::string& path) { requireReadableIni(path); },
      [](const std::string& path) { readJson(path); },
      [](const std::string& path) { readTumTrajectory(path); },
      [](const std::string& path) { sha256OfFile(path); },
      [](const std::string& path) { GzInput file(path); }};
  const TemporaryFolder folder;
  const auto pipe = folder.path("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), S_IRUSR | S_IWUSR), 0);
  for (std::size_t i = 0; i < readers.size(); ++i)
    for (const std::string& path : {pipe, std::string("/dev/zero")})
      EXPECT_EQ(errorOf([&] { readers[i](path); }), path + ": is a pipe or a device, not a file")
          << i;
}
