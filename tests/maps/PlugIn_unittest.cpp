// The map class inside MRPT's own programs, as Debian ships them (package mrpt-apps).
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/serialization/CArchive.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "ObjectMapFixture.h"

using namespace quadmap;
using namespace quadmap::testing;

namespace
{
const std::string kLibrary = std::string(QUADMAP_LIB_DIR) + "/libquadmap-maps.so";

struct Result
{
  int status = -1;
  std::string output;  // both streams
};

Result run(const std::string& command)
{
  Result result;
  FILE* pipe = popen((command + " 2>&1 </dev/null").c_str(), "r");
  if (!pipe) return result;
  std::array<char, 4096> buffer;
  while (const auto n = fread(buffer.data(), 1, buffer.size(), pipe))
    result.output.append(buffer.data(), n);
  result.status = pclose(pipe);
  return result;
}

bool isInstalled(const std::string& program)
{
  return std::system(("command -v " + program + " >/dev/null").c_str()) == 0;
}

/** A sanitizer must be the first library of a process; a preloaded plug-in cannot be. */
constexpr bool kSanitized =
#ifdef QUADMAP_SANITIZED
    true;
#else
    false;
#endif

class PlugIn : public ::testing::Test
{
 protected:
  std::filesystem::path folder_;

  void SetUp() override
  {
    if (kSanitized) GTEST_SKIP() << "MRPT's programs are not built with the sanitizer";
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) /
              (std::string("quadmap_plugin_") + info->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /** Ten frames around a cabinet. */
  template <typename Visit>
  void frames(const Visit& visit)
  {
    const std::vector<TrueObject> world = {cuboid("suitcase", {0, 0, 0.3}, {0.7, 0.4, 0.6}, 0.4)};
    SyntheticCamera camera(3);
    for (int i = 0; i < 10; ++i)
    {
      const auto T =
          SyntheticCamera::lookAt({2 * std::cos(0.6 * i), 2 * std::sin(0.6 * i), 1.2}, {0, 0, 0.3});
      visit(T, std::make_shared<CObservationObjects>(camera.observe(T, world)));
    }
  }
};

}  // namespace

TEST_F(PlugIn, RawlogEditReadsOurObservations)
{
  if (!isInstalled("rawlog-edit")) GTEST_SKIP() << "mrpt-apps is not installed";
  {
    mrpt::io::CFileGZOutputStream file(path("boxes.rawlog"));
    auto archive = mrpt::serialization::archiveFrom(file);
    frames([&](const auto&, const auto& boxes) { archive << *boxes; });
  }
  const std::string arguments = " --info -i " + path("boxes.rawlog");
  const Result with = run("rawlog-edit -p " + kLibrary + arguments);
  EXPECT_EQ(with.status, 0) << with.output;
  EXPECT_NE(with.output.find("Overall number of objects         : 10"), std::string::npos)
      << with.output;
  const Result without = run("rawlog-edit" + arguments);
  EXPECT_EQ(without.output.find("number of objects         : 10"), std::string::npos)
      << "the plug-in makes the difference";
}

TEST_F(PlugIn, Observations2MapBuildsOurMap)
{
  if (!isInstalled("observations2map")) GTEST_SKIP() << "mrpt-apps is not installed";
  mrpt::maps::CSimpleMap simple;
  frames(
      [&](const auto& T, const auto& boxes)
      {
        mrpt::obs::CSensoryFrame frame;
        frame.insert(boxes);
        simple.insert(mrpt::poses::CPose3DPDFGaussian(T), frame);
      });
  ASSERT_TRUE(simple.saveToFile(path("boxes.simplemap")));
  for (const std::string name : {"CQuadricObjectMap", "quadricObjectMap"})
  {
    std::ofstream(path("map.ini"))
        << "[map]\n"
        << name << "_count=1\n[map_" << name << "_00_insertOpts]\nminComplete=5\n";
    const std::string prefix = path("out_" + name);
    const Result result =
        run("LD_PRELOAD=" + kLibrary + " observations2map " + path("map.ini") + " " +
            path("boxes.simplemap") + " " + prefix + " -s map");
    EXPECT_EQ(result.status, 0) << result.output;
    const auto records = readObjectsJson(prefix + "_quadmap__CQuadricObjectMap_00.json");
    ASSERT_EQ(records.size(), 1u) << result.output;
    EXPECT_EQ(records[0].label, "suitcase");
    EXPECT_EQ(records[0].observations, 10u);
    EXPECT_LT((records[0].object.center() - Eigen::Vector3d(0, 0, 0.3)).norm(), 0.03);
  }
}
