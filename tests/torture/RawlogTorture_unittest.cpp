#include <gtest/gtest.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include "../slam/SyntheticRoom.h"
#include "Damages.h"

using namespace quadmap;
using namespace quadmap::torture;

namespace
{
using Records = std::vector<mrpt::serialization::CSerializable::Ptr>;

/** Images with pixels in a JPEG, poses and boxes of a small room. */
class RawlogTorture : public ::testing::Test
{
 protected:
  RawlogTorture()
  {
    mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(false);
    room_.camera = {65, 65, 39.5, 29.5, 80, 60};
    for (int i = 0; i < 3; ++i)
    {
      const auto pose = room_.robotAt(0.1 * i);
      scans_.push_back(room_.scanFrom(pose, kStart + i));
      boxes_.push_back(room_.boxesOf(*scans_.back(), pose));
      poses_.push_back(samplePose(kStart + i, pose));
    }
  }
  ~RawlogTorture() override { mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(true); }

  std::string bytesOf(const Records& records) const
  {
    return readFile(writeObjects(folder_.path("scratch"), records, /*compressed*/ false));
  }
  Records recording() const
  {
    Records all;
    for (std::size_t i = 0; i < scans_.size(); ++i)
      all.insert(all.end(), {poses_[i], scans_[i], boxes_[i]});
    return all;
  }
  void judgeRawlogs(const Cases& cases) const
  {
    std::filesystem::remove(folder_.path("scratch"));
    judge(folder_, {"quadmap-slam IN -o OUT --every 1 --threads 1", "x.rawlog", ""}, cases);
  }

  TemporaryFolder folder_;
  SyntheticRoom room_;
  std::vector<mrpt::obs::CObservation3DRangeScan::Ptr> scans_;
  std::vector<CObservationObjects::Ptr> boxes_;
  std::vector<mrpt::obs::CObservationRobotPose::Ptr> poses_;
};

/** Objects of the class, one inside the other. */
std::string nested(const std::string& name, int version, int depth)
{
  const std::string head = object(name, version, littleEndian(1));
  std::string bytes;
  for (int i = 0; i < depth; ++i) bytes += head.substr(0, head.size() - 1);
  return bytes;
}
}  // namespace

TEST_F(RawlogTorture, CutsAndFlippedBits)
{
  const auto whole = bytesOf(recording());
  judgeRawlogs(
      cuts(gzipped(whole), 8) + cuts(whole, 12) + flips(gzipped(whole), 30) + flips(whole, 16) +
      compressed(flips(whole, 16)));
}

TEST_F(RawlogTorture, HugeNumbersInEveryPart)
{
  const auto whole = bytesOf({poses_[0], scans_[0]}), boxes = bytesOf({boxes_[0]});
  const auto head = whole.find("CObservation3DRangeScan");
  const auto tail = whole.size() - 900;  // calibration, labels and what follows the images
  Cases cases;
  for (const auto& c : hugeNumbers(whole.substr(head, 400), 15))
    cases.push_back({c.name, whole.substr(0, head) + c.bytes + whole.substr(head + 400) + boxes});
  for (const auto& c : hugeNumbers(whole.substr(tail), 30))
    cases.push_back({c.name, whole.substr(0, tail) + c.bytes + boxes});
  judgeRawlogs(at("x.rawlog: record 1", cases));
}

TEST_F(RawlogTorture, SizesOfARangeScan)
{
  const auto whole = bytesOf({poses_[0], scans_[0], boxes_[0]});
  const auto size = littleEndian(60) + littleEndian(80);  // rows and columns of the depth image
  const auto imageSize = littleEndian(80) + littleEndian(60);
  const auto label = littleEndian(6) + "camera";
  const auto version = std::string("CObservation3DRangeScan\x0a");
  Cases cases;
  for (const auto& [rows, columns] : std::vector<std::pair<std::uint32_t, std::uint32_t>>{
           {         0,         80},
           {        60,          0},
           {0xffffffff, 0xffffffff},
           {     65536,      65536},
           {   0x10000,    0x10000},
           {     20000,      20000},
           {      4000,       4000},
           {  1u << 31,          2},
           {         0,          0}
  })
    cases.push_back(
        {mrpt::format("depth of %ux%u", rows, columns),
         with(whole, size, littleEndian(rows) + littleEndian(columns)), true});
  for (const std::int32_t side : {-65536, -20000, 0, -1})
    cases.push_back(
        {mrpt::format("colour of %d", side),
         with(
             whole, imageSize,
             littleEndian(static_cast<std::uint32_t>(side)) +
                 littleEndian(static_cast<std::uint32_t>(side))),
         true});
  for (const std::uint32_t length : {0xffffffffu, 0x7fffffffu, 100000u})
    cases.push_back({"a long label", with(whole, label, littleEndian(length) + "camera"), true});
  for (char v = 0; v < 10; v = static_cast<char>(v + 1))
    cases.push_back(
        {"version " + std::to_string(v),
         with(whole, version, version.substr(0, version.size() - 1) + v), v < 8});
  judgeRawlogs(at("x.rawlog: record 1", cases + compressed({cases[2], cases[3], cases[5]})));
}

TEST_F(RawlogTorture, EmbeddedJpeg)
{
  const auto whole = bytesOf({poses_[0], scans_[0], boxes_[0]});
  const auto begin = whole.find("\xff\xd8\xff"), end = whole.find("\xff\xd9", begin);
  const auto jpeg = whole.substr(begin, end + 2 - begin);
  const std::string frame = std::string("\xff\xc0\x00\x11\x08", 5);
  Cases cases;
  for (const char* side : {"\xff\xdc", "\x7f\xff", "\x40\x01"})
    cases.push_back(
        {"a huge size", with(whole, frame + std::string("\0\x3c\0\x50", 4), frame + side + side),
         true});
  const auto huffman = jpeg.find("\xff\xc4");
  for (std::size_t i = 0; i < 20; ++i)  // the counts of codes of each length
  {
    std::string broken = jpeg;
    broken[huffman + 4 + i] = '\xff';
    cases.push_back({"Huffman table, byte " + std::to_string(i), with(whole, jpeg, broken)});
  }
  for (const std::size_t at : {0ul, 2ul, 20ul, 160ul, jpeg.size() / 2})
    cases.push_back(
        {"zeros in the JPEG",
         with(whole, jpeg, jpeg.substr(0, at) + std::string(jpeg.size() - at, '\0')), at < 160});
  for (const std::uint32_t bytes : {0xffffffffu, 0x7fffffffu, 0u})
    cases.push_back(
        {"a wrong length of the JPEG",
         with(
             whole, littleEndian(static_cast<std::uint32_t>(jpeg.size())) + jpeg,
             littleEndian(bytes) + jpeg),
         true});
  judgeRawlogs(at("x.rawlog: record 1", cases));
}

TEST_F(RawlogTorture, MuchInLittle)
{
  const auto repeated = [](const std::string& part, std::size_t times)
  {
    std::string all;
    for (std::size_t i = 0; i < times; ++i) all += part;
    return all;
  };
  const auto packed = [&](const std::string& part, std::size_t bytes)
  {
    const auto member = gzipped(part);
    return repeated(member, bytes / member.size());
  };
  constexpr std::size_t kPacked = 4u << 20, kPart = 1u << 20;
  const auto frame = object("mrpt::obs::CSensoryFrame", 2, littleEndian(0));
  const auto comment = [](std::uint32_t letters)
  {
    return object(
        "mrpt::obs::CObservationComment", 0,
        littleEndian(letters) + std::string(letters, ' ') + std::string(8, '\0'));
  };
  judgeRawlogs({
      {  "20 million frames",      packed(repeated(frame,      kPart / frame.size()), kPacked),true},
      {"12 million comments", packed(repeated(comment(0), kPart / comment(0).size()), kPacked),
       true},
      {       "4 GB of text",  packed(comment(32u << 20),                   kPacked),     true     }
  });
}

TEST_F(RawlogTorture, FramesAndActions)
{
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(scans_[0]);
  auto laser = mrpt::obs::CObservation2DRangeScan::Create();
  laser->resizeScan(30);
  frame->insert(laser);
  mrpt::obs::CActionCollection actions;
  mrpt::obs::CActionRobotMovement2D flat;
  flat.computeFromOdometry({0.1, 0, 0}, {});
  actions.insert(flat);
  mrpt::obs::CActionRobotMovement3D spatial;
  spatial.estimationMethod = mrpt::obs::CActionRobotMovement3D::emOdometry;
  actions.insert(spatial);
  const auto moves = bytesOf({std::make_shared<mrpt::obs::CActionCollection>(actions)});
  const auto whole = moves + bytesOf({frame});
  Cases cases = hugeNumbers(moves, 40) + flips(moves, 20);
  for (auto& c : cases) c.bytes += bytesOf({frame});
  for (const std::uint32_t count : {0xffffffffu, 0x10000000u, 2000u})
    cases.push_back(
        {"a frame of " + std::to_string(count),
         with(
             whole, "CSensoryFrame\x02" + littleEndian(2),
             "CSensoryFrame\x02" + littleEndian(count)),
         true});
  for (const int depth : {5, 100, 30000, 300000})
    for (const char* name : {"mrpt::obs::CSensoryFrame", "CSensoryFrame"})
      cases.push_back({"nested frames", nested(name, 2, depth), true});
  cases.push_back({"nested actions", nested("mrpt::obs::CActionCollection", 0, 30000), true});
  cases.push_back({"particles", with(moves, littleEndian(300), littleEndian(0xfffffff0)), true});
  cases.push_back(
      {"a thousand million rays", with(whole, littleEndian(30), littleEndian(1u << 30)), true});
  judgeRawlogs(cases);
}

TEST_F(RawlogTorture, PixelLabels)
{
  auto labels = std::make_shared<mrpt::obs::TPixelLabelInfo<1>>();
  labels->setSize(60, 80);
  labels->setLabelName(0, "suitcase");
  for (int row = 20; row < 40; ++row)
    for (int column = 20; column < 60; ++column) labels->setLabel(row, column, 0);
  scans_[0]->pixelLabels = labels;
  const auto whole = bytesOf({poses_[0], scans_[0]});
  const auto size = std::string("\x01\x01") + littleEndian(60) + littleEndian(80);
  Cases cases;
  for (const std::uint32_t side : {0u, 61u, 4000u, 65536u, 0x7fffffffu, 0xffffffffu})
    cases.push_back(
        {"labels of size " + std::to_string(side),
         with(whole, size, std::string("\x01\x01") + littleEndian(side) + littleEndian(side)),
         true});
  for (const char bytes : {'\0', '\2', '\5', 'd'})
    cases.push_back(
        {"labels of other bits", with(whole, size, std::string("\x01") + bytes + size.substr(2)),
         true});
  const auto names = whole.substr(whole.size() - 60);
  for (const auto& c : hugeNumbers(names, 12))
    cases.push_back({c.name, whole.substr(0, whole.size() - 60) + c.bytes});
  judgeRawlogs(at("x.rawlog: record 1", cases));
}

TEST_F(RawlogTorture, ExternalImages)
{
  folder_.write("secret.jpg", "nobody's business");
  std::filesystem::create_directory(folder_.path("x_Images"));
  std::filesystem::create_symlink(folder_.path("secret.jpg"), folder_.path("x_Images/link.jpg"));
  std::filesystem::create_directory_symlink("/", folder_.path("x_Images/root"));
  Cases cases;
  for (const std::string& name :
       {std::string("/etc/passwd"), std::string("../secret.jpg"), std::string("a/../../secret.jpg"),
        std::string("link.jpg"), std::string("root/etc/passwd"), std::string("nothing.jpg"),
        std::string("x"), std::string(""), std::string("/dev/zero"), std::string("\x1b[31m.jpg"),
        std::string(5000, 'a')})
  {
    auto scan = room_.scanFrom(room_.robotAt(0), kStart);
    scan->intensityImage.setExternalStorage(name);
    cases.push_back({"colour named " + name, bytesOf({poses_[0], scan}), true});
  }
  judgeRawlogs(at("x.rawlog: record 1 (camera): ", cases));
}

TEST_F(RawlogTorture, WrongClocks)
{
  Cases cases;
  for (const double time : {-1e9, 0.0, 1e-3, 1e10, kStart, kStart - 1, kStart + 3600})
  {
    auto scan = room_.scanFrom(room_.robotAt(0.1), time);
    cases.push_back({"a scan at " + std::to_string(time), bytesOf({poses_[0], scans_[0], scan})});
    cases.push_back(
        {"a pose at " + std::to_string(time),
         bytesOf({poses_[0], scans_[0], samplePose(time, {}), scans_[1], poses_[2]})});
  }
  for (const int burst : {1, 2, 5})
    for (const double ahead : {-3600, 3600})
    {
      Records records{poses_[0], scans_[0]};
      for (int i = 1; i < 12; ++i)
        records.push_back(
            samplePose(kStart + 0.1 * i + (i >= 3 && i < 3 + burst ? ahead : 0.0), {}));
      cases.push_back(
          {mrpt::format("%d poses %g s ahead", burst, ahead), bytesOf(records), true,
           // An hour before the start it is not yet 1970, a time that stamps do not have.
           std::string("x.rawlog: record 4 (odometry): ") + (ahead < 0 ? "has the" : "the") +
               " time "});
    }
  judgeRawlogs(cases);
}

TEST_F(RawlogTorture, Sidecar)
{
  writeObjects(folder_.path("x.rawlog"), {poses_[0], scans_[0], poses_[1], scans_[1]});
  const auto whole = bytesOf({boxes_[0], boxes_[1]});
  Cases cases = cuts(gzipped(whole), 4) + cuts(whole, 8) + flips(gzipped(whole), 25) +
                hugeNumbers(whole.substr(0, whole.size() / 2), 30);
  auto many = room_.boxesOf(*scans_[0], room_.robotAt(0));
  many->objects.resize(CObservationObjects::kMostObjects, many->objects[0]);
  const auto most = bytesOf({many});
  cases.push_back({"as many boxes as possible", most});
  cases.push_back(
      {"100,000 boxes",
       with(most, littleEndian(CObservationObjects::kMostObjects), littleEndian(100000)), true});
  ObjectMask mask;
  mask.width = mask.height = 4096;
  mask.pixels.append(4096 * 4096, false);
  many->objects.resize(8);
  for (auto& object : many->objects) object.mask = mask;
  cases.push_back({"128 MB of masks", bytesOf({many}), true});
  std::filesystem::remove(folder_.path("scratch"));
  judge(
      folder_, {"quadmap-slam DIR/x.rawlog -o OUT --every 1 --threads 1", "x.objects.rawlog", "x."},
      cases);
}
