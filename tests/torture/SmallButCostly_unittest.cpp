#include <gtest/gtest.h>
#include <sys/stat.h>

#include "../sensors/records/ThrunMotion.h"
#include "../slam/SyntheticRoom.h"
#include "Damages.h"
#include "quadmap/base/GzipInput.h"

using namespace quadmap;
using namespace quadmap::torture;

namespace
{
/** Small files that ask for much memory or time. */
class SmallButCostly : public ::testing::Test
{
 protected:
  SmallButCostly()
  {
    room_.camera = {65, 65, 39.5, 29.5, 80, 60};
    for (int i = 0; i < 3; ++i)
      scans_.push_back(room_.scanFrom(room_.robotAt(0.1 * i), kStart + i));
  }

  /** A file that nobody writes, so that reading it does not end. */
  std::string pipe() const
  {
    const std::string path = elsewhere_.path("pipe");
    ::mkfifo(path.c_str(), 0600);
    return path;
  }

  std::string bytesOf(const std::vector<mrpt::serialization::CSerializable::Ptr>& records) const
  {
    const TemporaryFolder scratch;
    return readFile(writeObjects(scratch.path("x"), records, /*compressed*/ false));
  }

  /** Maps with one of these objects as the first observation of the first keyframe. */
  Cases inASimpleMap(Cases cases) const
  {
    writeObjects(
        folder_.path("x.rawlog"), {samplePose(kStart, {}), scans_[0], samplePose(kStart + 1, {}),
                                   scans_[1], room_.boxesOf(*scans_[0], room_.robotAt(0))});
    const std::string command = QUADMAP_BIN_DIR "/quadmap-slam " + folder_.path("x.rawlog") +
                                " --every 1 -o " + folder_.path("run") + " >/dev/null";
    if (std::system(command.c_str()) != 0) throw std::logic_error("there is no map");
    GzInput file(folder_.path("run/map.simplemap"));
    std::string whole(std::size_t{1} << 20, '\0');
    whole.resize(file.readSome(whole.data(), whole.size()));
    const auto frame = whole.find("CSensoryFrame\x02") + 14;
    for (auto& c : cases)
      c.bytes = whole.substr(0, frame) + littleEndian(9) + c.bytes + whole.substr(frame + 4);
    return compressed(cases);
  }

  TemporaryFolder folder_, elsewhere_;
  SyntheticRoom room_;
  std::vector<mrpt::obs::CObservation3DRangeScan::Ptr> scans_;
};

const Reader kRawlog{"quadmap-slam IN -o OUT --every 1 --threads 1", "x.rawlog", ""};

/** Objects of classes with vectors and matrices of MRPT, for which it makes room as it is told. */
Cases objectsOfHugeCounts()
{
  const std::string rest(100, '\0'), twoNumbers(16, '\0');
  Cases cases;
  for (const std::uint32_t n : {40000000u, 0x10000000u, 0xffffffffu})
  {
    const std::string count = littleEndian(n), name = " of " + std::to_string(n);
    cases.push_back(
        {"batteries" + name,
         object("mrpt::obs::CObservationBatteryState", 2, twoNumbers + "\x01\x01" + count + rest)});
    cases.push_back({"a matrix" + name, object("mrpt::math::CMatrixD", 0, count + count + rest)});
    cases.push_back({"Gaussians" + name, object("mrpt::poses::CPose3DPDFSOG", 2, count + rest)});
  }
  for (auto& c : cases) c.mustFail = true;
  return cases;
}

std::string repeated(const std::string& text, int times)
{
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

/** A mesh as MRPT stores it: how it is drawn, its file's name and its file. */
std::string mesh(const std::string& file)
{
  std::string look("\xff\xc1\0\0\xff\xff\xff\xff", 8);
  look.resize(46, '\0');
  look[27] = '\x80';
  look[33] = '\x01';
  return object(
      "mrpt::opengl::CAssimpModel", 2,
      look + '\0' + littleEndian(1) + 'x' + littleEndian(static_cast<std::uint32_t>(file.size())) +
          file + littleEndian(0));
}

std::string octree(const std::string& className, const std::string& kind, int levels)
{
  const std::string file = "# Octomap OcTree binary file\nid " + kind + "\nsize " +
                           std::to_string(levels) + "\nres 0.1\ndata\n" +
                           repeated(std::string("\x03\0", 2), levels);
  return object(
      className, 3,
      std::string("\0\1\0\0\0\0\0\1\1\1\1", 11) +
          object("mrpt::maps::TMapGenericParams", 0, "\1\1\1") +
          littleEndian(static_cast<std::uint32_t>(file.size())) + file);
}

/** Objects that MRPT gives to readers of other libraries, which follow each level of them by a call
 * and open the files named in them.
 * \param pipe A file that nobody writes. */
Cases objectsOfOtherLibraries(const std::string& pipe)
{
  constexpr int kLevels = 300000;
  return {
      {           "a mesh of many levels",
       mesh("xof 0303txt 0032\n" + repeated("Frame a{\n", kLevels) + repeated("}", kLevels)), true                                                             },
      {          "a mesh of another file",
       mesh("# x\nmtllib " + pipe + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"),                    true          },
      {        "an octree of many levels",                octree("mrpt::maps::COctoMap",                "OcTree",  kLevels), true},
      {"a coloured octree of many levels",
       octree("mrpt::maps::CColouredOctoMap",           "ColorOcTree",  kLevels), true                                                                          },
  };
}
}  // namespace

TEST_F(SmallButCostly, CountsInOtherClasses)
{
  Cases cases = objectsOfHugeCounts();
  const auto frame = object("mrpt::obs::CSensoryFrame", 2, littleEndian(1));
  for (const Case& c : objectsOfHugeCounts())
    cases.push_back({c.name + " in a frame", frame.substr(0, frame.size() - 1) + c.bytes, true});
  for (auto& c : cases) c.bytes = bytesOf({scans_[0]}) + c.bytes + bytesOf({scans_[1]});
  judge(folder_, kRawlog, at("x.rawlog: record 1", cases));
  judge(folder_, {"quadmap-import rawlog IN -o OUT", "x.rawlog", ""}, cases);
}

TEST_F(SmallButCostly, CountsInOtherClassesOfASidecar)
{
  writeObjects(folder_.path("x.rawlog"), {scans_[0], scans_[1]});
  judge(
      folder_, {"quadmap-slam DIR/x.rawlog -o OUT --every 1 --threads 1", "x.objects.rawlog", ""},
      at("x.objects.rawlog: record 0", objectsOfHugeCounts()));
}

TEST_F(SmallButCostly, CountsInASimpleMap)
{
  judge(
      folder_, {"quadmap-export DIR/run --ply OUT", "run/map.simplemap", "map.simplemap"},
      inASimpleMap(objectsOfHugeCounts()));
}

TEST_F(SmallButCostly, MeshesAndOctrees)
{
  Cases cases = objectsOfOtherLibraries(pipe());
  const auto frame = object("mrpt::obs::CSensoryFrame", 2, littleEndian(1));
  for (const Case& c : objectsOfOtherLibraries(pipe()))
    cases.push_back({c.name + " in a frame", frame.substr(0, frame.size() - 1) + c.bytes, true});
  for (auto& c : cases) c.bytes = bytesOf({scans_[0]}) + c.bytes + bytesOf({scans_[1]});
  cases = compressed(cases);
  judge(folder_, kRawlog, at("x.rawlog: record 1", cases));
  judge(folder_, {"quadmap-import rawlog IN -o OUT", "x.rawlog", ""}, cases);
}

TEST_F(SmallButCostly, MeshesAndOctreesOfASidecar)
{
  writeObjects(folder_.path("x.rawlog"), {scans_[0], scans_[1]});
  judge(
      folder_, {"quadmap-slam DIR/x.rawlog -o OUT --every 1 --threads 1", "x.objects.rawlog", ""},
      at("x.objects.rawlog: record 0", compressed(objectsOfOtherLibraries(pipe()))));
}

TEST_F(SmallButCostly, MeshesAndOctreesInASimpleMap)
{
  judge(
      folder_, {"quadmap-export DIR/run --ply OUT", "run/map.simplemap", "map.simplemap"},
      inASimpleMap(objectsOfOtherLibraries(pipe())));
}

TEST_F(SmallButCostly, ParticlesOfActions)
{
  const auto move = thrunMotion(77777);
  auto actions = mrpt::obs::CActionCollection::Create();
  actions->insert(move);
  const auto action = with(bytesOf({actions}), littleEndian(77777), littleEndian(100000));
  std::string many;
  for (int i = 0; i < 2000; ++i) many += action;
  judge(
      folder_, kRawlog,
      {
          {"200 million particles", many + bytesOf({scans_[0]}), true, ""}
  });
}

TEST_F(SmallButCostly, MasksOfManyPixels)
{
  const auto pose = room_.robotAt(0);
  auto boxes = room_.boxesOf(*scans_[0], pose);
  ASSERT_FALSE(boxes->objects.empty());
  ObjectMask mask;
  mask.width = mask.height = 4096;
  mask.pixels.append(4096 * 4096, true);
  boxes->objects.resize(4, boxes->objects[0]);
  for (auto& object : boxes->objects) object.mask = mask;
  std::string many;
  const auto one = bytesOf({boxes});
  for (int i = 0; i < 3000; ++i) many += one;
  writeObjects(folder_.path("x.rawlog"), {samplePose(kStart, pose), scans_[0]});
  const std::string command = "quadmap-slam DIR/x.rawlog -o OUT --every 1 --threads 1";
  judge(
      folder_,
      {
          command, "x.objects.rawlog", "x."
  },
      compressed({{"200,000 million pixels beside a rawlog", many}}));
  std::filesystem::remove(folder_.path("x.objects.rawlog"));
  judge(
      folder_, kRawlog,
      compressed({
          {"200,000 million pixels", many + bytesOf({samplePose(kStart, pose), scans_[0]})}
  }));
}
