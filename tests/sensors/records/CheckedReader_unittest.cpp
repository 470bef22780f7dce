#include "quadmap/sensors/CheckedReader.h"

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBatteryState.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/obs/TPixelLabelInfo.h>

#include <cstring>

#include "../SampleRawlog.h"
#include "ObjectBytes.h"
#include "ThrunMotion.h"
#include "quadmap/base/GzipInput.h"

using namespace quadmap;
using mrpt::serialization::CSerializable;

namespace
{
mrpt::obs::CObservationStereoImages::Ptr stereoPair()
{
  auto pair = mrpt::obs::CObservationStereoImages::Create();
  pair->imageLeft = pair->imageRight = sampleScan(kStart)->intensityImage;
  return pair;
}

/** Objects of all classes whose layout is known, with all their optional parts, and others that
 * hold some of them. */
std::vector<CSerializable::Ptr> samplesOfAllClasses()
{
  using namespace mrpt::obs;
  auto scan = sampleScan(kStart);
  auto labels = std::make_shared<TPixelLabelInfo<2>>();
  labels->setSize(5, 7);
  labels->setLabel(2, 3, 1);
  labels->setLabelName(1, "chair");
  scan->pixelLabels = labels;
  scan->rangeImageOtherLayers["second"].resize(5, 5);  // MRPT swaps rows and columns
  scan->hasConfidenceImage = true;
  scan->confidenceImage = mrpt::img::CImage(3, 2, mrpt::img::CH_GRAY);
  auto points = sampleScan(kStart);
  points->hasRangeImage = points->hasIntensityImage = false;
  points->hasPoints3D = true;
  auto external = sampleScan(kStart);
  external->intensityImage.setExternalStorage("a.jpg");

  auto laser = CObservation2DRangeScan::Create();
  laser->resizeScan(4);
  laser->setScanHasIntensity(true);
  auto wheels = CObservationOdometry::Create();
  wheels->hasEncodersInfo = wheels->hasVelocities = true;
  auto image = CObservationImage::Create();
  image->image = mrpt::img::CImage(3, 2, mrpt::img::CH_RGB);

  auto actions = CActionCollection::Create();
  CActionRobotMovement2D flat, matched;
  flat.computeFromOdometry({0.1, 0, 0}, {});
  flat.hasVelocities = flat.hasEncodersInfo = true;
  matched.estimationMethod = CActionRobotMovement2D::emScan2DMatching;
  actions->insert(flat);
  actions->insert(matched);
  actions->insert(CActionRobotMovement3D());
  auto frame = CSensoryFrame::Create();
  for (const CObservation::Ptr& o :
       {CObservation::Ptr(scan), CObservation::Ptr(laser), CObservation::Ptr(sampleBoxes(kStart)),
        CObservation::Ptr(CObservationComment::Create()), CObservation::Ptr(wheels)})
    frame->insert(o);
  auto map = std::make_shared<mrpt::maps::CSimpleMap>();
  map->insert(mrpt::poses::CPose3DPDF::Ptr(new mrpt::poses::CPose3DPDFGaussian()), frame);
  return {
      scan,
      points,
      external,
      laser,
      wheels,
      image,
      samplePose(kStart, {}),
      frame,
      actions,
      CObservationIMU::Create(),
      sampleBoxes(kStart),
      CObservationComment::Create(),
      stereoPair(),
      map};
}

class WithJpeg : public ::testing::Test
{
 protected:
  WithJpeg() { mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(false); }
  ~WithJpeg() override { mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(true); }
};
}  // namespace

TEST(CheckedReader, GivesEveryObjectAsMrptDoes)
{
  registerObsClasses();
  const TemporaryFolder folder;
  const auto objects = samplesOfAllClasses();
  GzInput file(writeObjects(folder.path("x"), objects));
  CheckedReader reader(file);
  for (const auto& object : objects)
  {
    SCOPED_TRACE(object->GetRuntimeClass()->className);
    file.startRecord();
    const auto copy = reader.next();
    ASSERT_TRUE(copy);
    EXPECT_TRUE(bytesOf(*copy) == bytesOf(*object));
  }
  file.startRecord();
  EXPECT_FALSE(reader.next());
}

TEST_F(WithJpeg, DecodesTheSamePixelsAsMrpt)
{
  const auto bytes = bytesOf(*sampleScan(kStart));
  mrpt::io::CMemoryStream memory(bytes.data(), bytes.size());
  const auto expected =
      mrpt::serialization::archiveFrom(memory).ReadObject<mrpt::obs::CObservation3DRangeScan>();
  const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(read(bytes));
  ASSERT_TRUE(scan);
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(true);  // so that the bytes are the pixels
  EXPECT_TRUE(bytesOf(*scan) == bytesOf(*expected));
}

TEST_F(WithJpeg, DamagedHuffmanTablesAreAnError)  // libjpeg alone ends the program
{
  auto bytes = bytesOf(*sampleScan(kStart));
  const auto table = bytes.find("\xff\xc4");
  ASSERT_NE(table, std::string::npos);
  for (std::size_t i = 5; i < 21; ++i) bytes[table + i] = '\xff';
  EXPECT_NE(errorOf([&] { read(bytes); }).find("cannot be read as an image"), std::string::npos);
}

TEST_F(WithJpeg, WhatFollowsADamagedImageIsRead)
{
  const TemporaryFolder folder;
  const auto first = bytesOf(*sampleScan(kStart)), last = bytesOf(*sampleScan(kStart + 2));
  auto bytes = bytesOf(*sampleScan(kStart + 1));
  bytes.replace(bytes.find("\xff\xda") + 14, 40, 40, '\0');  // the scan's first pixels
  GzInput file(folder.write("x", first + bytes + last));
  CheckedReader reader(file);
  file.startRecord();
  EXPECT_TRUE(reader.next());
  file.startRecord();
  try
  {
    reader.next();
    ADD_FAILURE() << "the damage is not seen";
  }
  catch (const DamagedImage& e)
  {
    EXPECT_EQ(e.sensor, "camera");
  }
  file.startRecord();
  EXPECT_TRUE(reader.next());
  file.startRecord();
  EXPECT_FALSE(reader.next());

  const auto rawlog = folder.path("x");
  const auto error = errorOf([&] { readAll(rawlog); });
  EXPECT_NE(error.find("x: record 1 (camera): "), std::string::npos) << error;
  RawlogSourceOptions keepGoing;
  keepGoing.keepGoing = true;
  EXPECT_EQ(readAll(rawlog, keepGoing).size(), 2u);
}

TEST_F(WithJpeg, LargeImagesAreRefusedByTheirHead)
{
  const auto bytes = bytesOf(*sampleScan(kStart));
  const std::string frame("\xff\xc0\x00\x11\x08", 5), size("\x00\x30\x00\x40", 4);
  const auto huge = with(bytes, frame + size, frame + "\xff\xdc\xff\xdc");
  EXPECT_NE(errorOf([&] { read(huge); }).find("65500x65500 pixels"), std::string::npos);
  RecordLimits limits;
  limits.imagePixels = kColumns * kRows;
  EXPECT_TRUE(read(bytes, limits));
  --limits.imagePixels;
  EXPECT_NE(errorOf([&] { read(bytes, limits); }), "");
}

TEST(CheckedReader, RefusesSizesThatCannotBe)
{
  const auto scan = bytesOf(*sampleScan(kStart));
  const auto size = number(kRows) + number(kColumns);
  for (const std::uint32_t n : {0u, 65536u, 0x7fffffffu, 0xffffffffu})
    EXPECT_NE(errorOf([&] { read(with(scan, size, number(n) + number(kColumns))); }), "") << n;
  const auto oneRow = with(scan, size, number(1) + number(40000));
  EXPECT_NE(errorOf([&] { read(oneRow); }).find("40000x1 pixels"), std::string::npos);
  const auto label = number(6) + "camera";
  EXPECT_NE(
      errorOf([&] { read(with(scan, label, number(70000) + "camera")); }).find("70000 characters"),
      std::string::npos);
  const std::string version = "CObservation3DRangeScan\x0a";
  EXPECT_NE(
      errorOf([&] { read(with(scan, version, std::string("CObservation3DRangeScan\0", 24))); })
          .find("is of version 0"),
      std::string::npos);
}

TEST(CheckedReader, FlagsAreNothingButZeroAndOne)
{
  auto bytes = bytesOf(*sampleScan(kStart));
  const std::size_t rangeIsDepth =
      bytes.size() - 5;  // three flags of a byte each follow, and a mark
  ASSERT_EQ(bytes.at(rangeIsDepth), 1);
  bytes[rangeIsDepth] = '\x81';
  const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(read(bytes));
  ASSERT_TRUE(scan);
  unsigned char stored = 0;
  std::memcpy(&stored, &scan->range_is_depth, sizeof stored);
  EXPECT_EQ(stored, 1) << "no other byte is a bool";
}

TEST(CheckedReader, LayersOfAScanShareThePixelsOfAnImage)
{
  const auto scan = sampleScan(kStart);
  RecordLimits limits;
  limits.imagePixels = kColumns * kRows;
  scan->rangeImageOtherLayers["first"].resize(kRows, kColumns);
  EXPECT_TRUE(read(bytesOf(*scan), limits));
  scan->rangeImageOtherLayers["second"].resize(1, 1);
  EXPECT_NE(errorOf([&] { read(bytesOf(*scan), limits); }).find("layers"), std::string::npos);
}

TEST(CheckedReader, LeavesOutThePointsOfAScan)
{
  const auto scan = sampleScan(kStart);
  const auto without = bytesOf(*scan);
  scan->hasPoints3D = true;
  scan->resizePoints3DVectors(5);
  const auto copy =
      std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(read(bytesOf(*scan)));
  ASSERT_TRUE(copy);
  EXPECT_TRUE(copy->hasPoints3D);
  EXPECT_TRUE(copy->points3D_x.empty());
  copy->hasPoints3D = false;
  EXPECT_TRUE(bytesOf(*copy) == without);
}

TEST(CheckedReader, AnEmptyObjectIsNotTheEndOfTheFile)
{
  const std::string empty = "\x87nullptr\x88";
  EXPECT_NE(errorOf([&] { read(empty + bytesOf(*sampleScan(kStart))); }), "");
}

TEST(CheckedReader, RefusesNestedFrames)
{
  const std::string head = "\x98mrpt::obs::CSensoryFrame\x02" + number(1);
  std::string bytes;
  for (int i = 0; i < 100000; ++i) bytes += head;
  EXPECT_NE(errorOf([&] { read(bytes); }).find("nested"), std::string::npos);
}

TEST(CheckedReader, RefusesNestingInsideOtherClasses)
{
  const std::string map = named("mrpt::maps::CSimpleMap") + "\x01" + number(1);
  for (const std::string& head :
       {named("mrpt::obs::CSensoryFrame") + "\x02", named("CSensorialFrame") + "\x02",
        named("mrpt::maps::CSimpleMap") + "\x01"})
  {
    std::string bytes = map;
    for (int i = 0; i < 100000; ++i) bytes += head + number(1);
    EXPECT_NE(errorOf([&] { read(bytes); }).find("nested"), std::string::npos) << head;
  }
}

TEST_F(WithJpeg, OfOtherClassesAreNotDecoded)  // libjpeg alone ends the program
{
  auto bytes = bytesOf(*stereoPair());
  const auto table = bytes.find("\xff\xc4");
  ASSERT_NE(table, std::string::npos);
  for (std::size_t i = 5; i < 21; ++i) bytes[table + i] = '\xff';
  const std::string name = named("mrpt::img::CImage");
  for (const auto& stored : {bytes, with(bytes, name, named("CMRPTImage"))})
  {
    const auto pair = std::dynamic_pointer_cast<mrpt::obs::CObservationStereoImages>(read(stored));
    ASSERT_TRUE(pair);
    EXPECT_TRUE(pair->imageLeft.isEmpty());
    EXPECT_TRUE(pair->imageRight.isEmpty());
  }
  const auto oldForm = with(bytes, name + "\x09", number(17) + name.substr(1) + number(9));
  EXPECT_NE(errorOf([&] { read(oldForm); }).find("no longer writes"), std::string::npos);
}

TEST(CheckedReader, LimitsTheMemoryOfOtherClasses)
{
#ifdef QUADMAP_SANITIZED
  GTEST_SKIP() << "sanitizers end the program when memory is refused";
#endif
  const mrpt::obs::CObservationComment comment;
  const auto bytes = bytesOf(comment);
  const std::string head =
      std::string("CObservationComment\0", 20);  // with its version; a text follows
  EXPECT_TRUE(read(bytes));
  EXPECT_NE(errorOf([&] { read(with(bytes, head + number(0), head + number(0xfffffff0))); }), "");
}

TEST(CheckedReader, LimitsTheMemoryOfMrptsVectors)
{
#ifdef QUADMAP_SANITIZED
  GTEST_SKIP() << "sanitizers end the program when memory is refused";
#endif
  mrpt::obs::CObservationBatteryState battery;
  battery.voltageOtherBatteries.resize(3);
  const auto bytes = bytesOf(battery);
  const std::string three = number(3) + std::string(3 * sizeof(double), '\0');
  EXPECT_TRUE(read(bytes));
  for (const std::uint32_t count : {40000000u, 0x10000000u, 0xffffffffu})
  {
    const auto much = with(bytes, three, number(count) + three.substr(4));
    EXPECT_NE(errorOf([&] { read(much); }).find("too much memory"), std::string::npos) << count;
  }
}

TEST(CheckedReader, DrawsNoParticlesOfAMotion)
{
  using mrpt::obs::CActionRobotMovement2D;
  const CActionRobotMovement2D move = thrunMotion(77777);
  mrpt::obs::CActionCollection actions;
  actions.insert(move);
  const auto bytes = bytesOf(actions);
  const auto copy = std::dynamic_pointer_cast<mrpt::obs::CActionCollection>(read(bytes));
  ASSERT_TRUE(copy);
  const auto& read2D = dynamic_cast<const CActionRobotMovement2D&>(*copy->get(0));
  const auto& model = read2D.motionModelConfiguration.thrunModel;
  EXPECT_EQ(model.nParticlesCount, 1u);
  EXPECT_EQ(read2D.rawOdometryIncrementReading, move.rawOdometryIncrementReading);
  EXPECT_FLOAT_EQ(model.alfa4_trans_rot, move.motionModelConfiguration.thrunModel.alfa4_trans_rot);
  const std::string name = "CActionRobotMovement2D";
  const auto older = with(bytes, name + '\x07', name + '\x03');
  EXPECT_NE(errorOf([&] { read(older); }).find("misreads"), std::string::npos);
}
