#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <sstream>

#include "../obs/SampleObservation.h"
#include "../obs/TemporaryFolder.h"
#include "Fuzz.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/obs/ObjectList.h"
#include "quadmap/obs/Trajectory.h"

using namespace quadmap;

namespace
{
std::string archiveBytes(const CObservationObjects& obs)
{
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << obs;
  return std::string(
      static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount());
}

/** Everything one does with a freshly read observation must work, too. */
void use(const CObservationObjects& obs)
{
  std::ostringstream text;
  obs.getDescriptionAsText(text);
  obs.exportTxtDataRow();
  for (const auto& object : obs.objects)
    if (object.mask)
    {
      object.mask->contains(0, 0);
      object.mask->contains(object.mask->x0, object.mask->y0);
    }
  archiveBytes(obs);
}
}  // namespace

TEST(Fuzz, ObservationArchive)
{
  FuzzRun run;
  run.count = 3000;
  fuzz(
      archiveBytes(sampleObservation()), run,
      [](const std::string& bytes)
      {
        mrpt::io::CMemoryStream stream(bytes.data(), bytes.size());
        auto archive = mrpt::serialization::archiveFrom(stream);
        CObservationObjects obs;
        archive >> obs;
        use(obs);
      });
}

TEST(Fuzz, ObjectsJson)
{
  const TemporaryFolder folder;
  ObjectRecord r;
  r.id = "1";
  r.label = "dining table";
  r.framesVisible = 3;
  r.observations = 17;
  r.existence = 0.5;
  r.labelCounts = {
      {"bench", 2}
  };
  r.covariance.emplace().setIdentity();
  ObjectRecord second = r;
  second.id = "left";
  second.covariance.reset();
  writeObjectsJson(folder.path("valid.json"), {r, second});

  FuzzRun run;
  run.words = {"\"id\":", "\"size\":", "null",    "true", "[[[[[[[[[[",
               "{\"a\":", ",",         "\\u0000", "e9"};
  fuzz(
      readFile(folder.path("valid.json")), run,
      [&](const std::string& text)
      { writeObjectsJson(folder.path("copy"), readObjectsJson(folder.write("in.json", text))); });
}

TEST(Fuzz, DeeplyNestedJson)
{
  const TemporaryFolder folder;
  for (const char* opening : {"[", "{\"objects\":[", "{\"a\":"})
  {
    std::string text;
    for (int i = 0; i < 20000; ++i) text += opening;
    const auto path = folder.write("deep.json", text);
    EXPECT_NE(errorOf([&] { readObjectsJson(path); }), "");
  }
}

TEST(Fuzz, LabelTable)
{
  const TemporaryFolder folder;
  FuzzRun run;
  run.words = {"[cup]", "[]", "aliases =", "confusedWith = cup", "${", "$env{", "@define", "<<<"};
  fuzz(
      "# comment\n[cup]\naliases = mug, tea cup\nshapeExponent = 1.4\ndominantDirection = no\n"
      "support = object\ntypicalSize = 0.1 0.1 0.1\nsizeSpread = 0.3\nconfusedWith = bowl\n"
      "\n[bowl]\nsupport = any\ntypicalSize = 0.2, 0.2, 0.1 // metres\nconfusedWith = mug\n"
      "[dining table]\nsupport = floor\ntypicalSize = 1.4 \\\n 0.9 0.75\n",
      run,
      [&](const std::string& text)
      {
        const auto table = LabelTable::fromFile(folder.write("labels.ini", text));
        for (const auto& [name, properties] : table.all())
          for (const auto& other : properties.confusedWith) table.compatible(name, other);
      });
}

TEST(Fuzz, Trajectory)
{
  const TemporaryFolder folder;
  std::string text = "# time tx ty tz qx qy qz qw\n";
  for (int i = 0; i < 20; ++i)
    text += "13418459" + std::to_string(10 + i) + ".747897 1.5 -0.25 1e-3 0.5 -0.5 0.5 0.5\n";
  fuzz(
      text, FuzzRun(),
      [&](const std::string& input)
      {
        const auto trajectory = readTumTrajectory(folder.write("in.tum", input));
        for (const auto& sample : trajectory) poseAt({sample, sample}, sample.time + 0.5, 1.0);
        writeTumTrajectory(folder.path("copy.tum"), trajectory);
      });
}
