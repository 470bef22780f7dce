#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>

#include <algorithm>

#include "MappedRoom.h"
#include "quadmap/evaluation/ObjectEvaluation.h"

using namespace quadmap;

namespace
{
/** Whether each face of a cuboid is within 2 cm of the true one, along the truth's axes, and its
 * shape is the true one to 0.85. Of round things any heading will do. */
bool isNearTruth(const ObjectRecord& truth, const ObjectRecord& proposal)
{
  const Eigen::Matrix3d R = truth.object.rotation();
  const Eigen::Vector3d shift = R.transpose() * (proposal.object.center() - truth.object.center());
  Eigen::Vector3d half = proposal.object.semiAxes();
  const Eigen::Vector3d trueHalf = truth.object.semiAxes();
  const bool isTurned =
      truth.orientationDefined
          ? std::abs(R.col(0).dot(proposal.object.rotation().col(0))) < std::sqrt(0.5)
          : (half.x() > half.y()) != (trueHalf.x() > trueHalf.y());
  if (isTurned) std::swap(half.x(), half.y());
  const double worst = (shift.cwiseAbs() + (half - trueHalf).cwiseAbs()).maxCoeff();
  return worst < 0.02 && compareObjects(truth, proposal).shapeIoU >= 0.85;
}

class QuadmapAnnotate : public ::testing::Test
{
 protected:
  void simulate(const std::string& scene, int frames) const
  {
    mapRoom(
        folder_.path("room"), scene + " --resolution 320x240 --frames " + std::to_string(frames),
        "--odometry ground-truth");
  }

  ProgramResult annotate(const std::string& options = "") const
  {
    ::unsetenv("DISPLAY");
    return runProgram(
        "quadmap-annotate",
        folder_.path("room") + " -o " + folder_.path("gt.json") + " " + options);
  }

  TemporaryFolder folder_;
};
}  // namespace

TEST_F(QuadmapAnnotate, AnswersWrongUsageAndInputWithOneLine)
{
  const auto expectError = [&](const std::string& arguments, int status, const std::string& text)
  {
    const auto result = runProgram("quadmap-annotate", arguments);
    EXPECT_EQ(result.status, status) << arguments;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find(text), kNotFound) << result.err;
  };
  const std::string here = folder_.folder().string();
  expectError(here, 2, "OUT.json");
  expectError(here + " -o truth.txt", 2, "must end in .json");
#ifdef QUADMAP_WITH_PCL
  expectError(here + "/none -o " + here + "/gt.json", 1, "none: is no folder");
  expectError(here + " -o " + here + "/gt.json", 1, "objects.json");
  folder_.write("gt.proposals.ini", "[objekt 1]\n");
  expectError(here + " -o " + here + "/gt.json", 1, "[objekt 1]");
  for (const char* without : {"", "; all are removed\n"})
  {
    folder_.write("gt.proposals.ini", without);
    expectError(here + " -o " + here + "/gt.json", 1, "gt.proposals.ini: has no proposal; remove");
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.path("gt.json")));
#else
  expectError(here + " -o " + here + "/gt.json", 1, "built without PCL");
#endif
}

TEST_F(QuadmapAnnotate, ReplacesNoFileOfTheRunThatItReads)
{
  std::filesystem::create_symlink("objects.json", folder_.path("link.json"));
  for (const char* name : {"objects.json", "report.json", "link.json"})
  {
    const std::string file = folder_.path(name);
    for (const char* kept : {"objects.json", "report.json"}) folder_.write(kept, kept);
    const auto result =
        runProgram("quadmap-annotate", folder_.folder().string() + " -o '" + file + "'");
    EXPECT_EQ(result.status, 2) << name;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find("-o: " + file + " is "), kNotFound) << result.err;
    for (const char* kept : {"objects.json", "report.json"})
      EXPECT_EQ(readFile(folder_.path(kept)), kept);
  }
}

#ifdef QUADMAP_WITH_PCL
TEST_F(QuadmapAnnotate, ProposesThingsOnADeskAsTheyAreAndTakesCorrections)
{
  simulate("cluttered-desk", 30);
  const auto result = annotate("--no-pictures");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto truth = readObjectsJson(folder_.path("room.objects.gt.json"));
  const auto nearTruth = [&](const std::vector<ObjectRecord>& proposals)
  {
    return std::count_if(
        proposals.begin(), proposals.end(),
        [&](const ObjectRecord& proposal)
        {
          return std::any_of(
              truth.begin(), truth.end(),
              [&](const ObjectRecord& object)
              { return object.label == proposal.label && isNearTruth(object, proposal); });
        });
  };
  const auto sure = readObjectsJson(folder_.path("gt.json"));
  EXPECT_GE(sure.size(), 7u);
  EXPECT_EQ(static_cast<std::size_t>(nearTruth(sure)), sure.size()) << "what is accepted at first";

  std::string file = readFile(folder_.path("gt.proposals.ini"));
  for (auto at = file.find("accept = no"); at != kNotFound; at = file.find("accept = no"))
    file.replace(at, 11, "accept = yes");
  folder_.write("gt.proposals.ini", file);
  ASSERT_EQ(annotate("--no-pictures").status, 0);
  const auto all = readObjectsJson(folder_.path("gt.json"));
  EXPECT_GT(all.size(), sure.size());
  EXPECT_GE(nearTruth(all), 18) << "of " << all.size();

  // One object is kept, with another size.
  folder_.write(
      "gt.proposals.ini",
      "[object 5]\nlabel = tea pot\naccept = yes\ncenter = 0.1 0 0.85\nsize = 0.2 0.1 0.3\n"
      "yaw_deg = 30\n[object 6]\nlabel = cup\naccept = no\ncenter = 0 0 0.8\nsize = 0.1 0.1 0.1\n");
  const auto again = annotate();
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.out.find("1 of 2 objects"), kNotFound) << again.out;
  const auto corrected = readObjectsJson(folder_.path("gt.json"));
  ASSERT_EQ(corrected.size(), 1u);
  EXPECT_EQ(corrected[0].id, "5");
  EXPECT_EQ(corrected[0].label, "tea pot");
  EXPECT_NEAR(corrected[0].object.semiAxes().z(), 0.15, 1e-9);
  EXPECT_NEAR(corrected[0].object.rotation()(1, 0), 0.5, 1e-9);
  for (const char* name : {"5_tea_pot.png", "6_cup.png"})
  {
    mrpt::img::CImage picture;
    ASSERT_TRUE(picture.loadFromFile(folder_.path(std::string("gt.pictures/") + name)));
    EXPECT_EQ(picture.getWidth(), 800u);
  }
}
#endif
