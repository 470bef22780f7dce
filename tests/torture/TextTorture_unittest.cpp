#include <gtest/gtest.h>

#include "../folders/SampleRecording.h"
#include "../slam/SyntheticRoom.h"
#include "Damages.h"

using namespace quadmap;
using namespace quadmap::torture;

namespace
{
/** What damages every text of keys and values. */
Cases damagesOf(const std::string& whole)
{
  Cases cases = cuts(whole, 5) + flips(whole, 12) + wrongWords(whole, 16);
  cases.push_back(
      {"40 MB of one key", whole + "\nx = " + std::string(40u << 20, 'y') + "\n", true});
  cases.push_back({"binary", std::string("\0\1\2\xff\xfe", 5), true});
  cases.push_back({"section twice", whole + "\n[a]\n[a]\n", true});
  cases.push_back({"no section", "key = value\n"});
  for (const char* line :
       {"x = $eval{repeat 1 until (0)}", "; $eval{repeat 1 until (0)}", "x = $env{HOME}",
        "@define a 1"})
    cases.push_back({line, whole + "\n" + line + "\n", true});
  return cases;
}

std::string share(const std::string& name)
{
  return readFile(QUADMAP_SOURCE_DIR "/share/quadmap/" + name);
}
}  // namespace

TEST(TextTorture, Configuration)
{
  const TemporaryFolder folder;
  const SyntheticRoom room;
  const auto pose = room.robotAt(0);
  const auto scan = room.scanFrom(pose, kStart);
  writeObjects(
      folder.path("x.rawlog"), {samplePose(kStart, pose), scan, room.boxesOf(*scan, pose)});
  auto cases = damagesOf(share("quadmap.ini"));
  for (const char* line :
       {"[slam]\nmethod = none", "[slam]\nthreads = -1", "[slam]\nthreads = 1e9",
        "[input]\nmaxBoxDelay = nan", "[input]\nmaxImageMegapixels = 99999999999",
        "[keyframes]\nevery = -1", "[slam\n", "[input]\nimagesAnywhere = perhaps"})
    cases.push_back({line, std::string(line) + "\n", true});
  judge(folder, {"quadmap-slam DIR/x.rawlog -o OUT --config IN", "x.ini", ""}, cases);
}

TEST(TextTorture, Scene)
{
  const TemporaryFolder folder;
  auto cases = damagesOf(share("scenes/corridor.ini"));
  cases.push_back(
      {"a way out of the room", with(share("scenes/approach.ini"), "-2.1 0.4 1.5", "-9.1 0.4 1.5"),
       true, "x.ini: [trajectory] frame 0 is outside the room"});
  judge(folder, {"quadmap-simulate IN -o OUT --frames 2 --resolution 64x64", "x.ini", ""}, cases);
}

TEST(TextTorture, Labels)
{
  const TemporaryFolder folder;
  const SyntheticRoom room;
  const auto pose = room.robotAt(0);
  const auto scan = room.scanFrom(pose, kStart);
  writeObjects(
      folder.path("x.rawlog"), {samplePose(kStart, pose), scan, room.boxesOf(*scan, pose)});
  ::setenv("QUADMAP_SHARE_DIR", folder.folder().c_str(), 1);
  judge(
      folder, {"quadmap-slam DIR/x.rawlog -o OUT", "labels.ini", ""},
      damagesOf(share("labels.ini")));
  ::unsetenv("QUADMAP_SHARE_DIR");
}

TEST(TextTorture, RecordingInTheLayoutOfTum)
{
  const SampleRecording recording;
  const std::string strict = "quadmap-import tum DIR -o OUT";
  for (const std::string& name :
       {std::string("calibration.yaml"), std::string("associations.txt"),
        std::string("groundtruth.txt"), SampleRecording::boxesFile(0)})
  {
    const std::string whole = readFile(recording.files.path(name));
    Cases cases = cuts(whole, 3) + flips(whole, 8) + wrongWords(whole, 16);
    judge(recording.files, {strict, name, "/quadmap-test-"}, cases);
    recording.files.write(name, whole);
  }
  std::string boxes;
  for (int i = 0; i <= 100000; ++i) boxes += "56 chair 0.8 10 12 30 40\n";
  judge(
      recording.files,
      {
          strict, SampleRecording::boxesFile(0), ""
  },
      {{"100,001 boxes", boxes, true}});
}

TEST(TextTorture, ImagesInTheLayoutOfTum)
{
  const SampleRecording recording;
  const std::string strict = "quadmap-import tum DIR -o OUT";
  for (const std::string name : {"rgb/f0.png", "depth/f0.png"})
  {
    const std::string whole = readFile(recording.files.path(name));
    const std::string size = std::string("\0\0\0\x40\0\0\0\x30", 8);
    Cases cases = cuts(whole, 5) + flips(whole, 15);
    for (const std::string& side :
         {std::string("\0\1\0\0", 4), std::string("\x7f\xff\xff\xff"),
          std::string("\0\0\xff\xdc", 4), std::string("\0\0\0\0", 4)})
      cases.push_back({"a wrong size", with(whole, size, side + side), true});
    judge(recording.files, {strict, name, ""}, cases);
    recording.files.write(name, whole);
  }
}
