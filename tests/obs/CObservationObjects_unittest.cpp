#include "quadmap/obs/CObservationObjects.h"

#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/serialization/CArchive.h>

#include <limits>
#include <random>
#include <sstream>

#include "SampleObservation.h"
#include "TemporaryFolder.h"
#include "quadmap/base/GzipStream.h"

using namespace quadmap;
using mrpt::serialization::archiveFrom;

namespace
{
/** Rounding of a rotation matrix that goes through a quaternion and back [-, m]. */
constexpr double kPoseRounding = 1e-14;

void expectEqual(const mrpt::poses::CPose3D& a, const mrpt::poses::CPose3D& b)
{
  EXPECT_LT(
      (a.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen() -
       b.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen())
          .cwiseAbs()
          .maxCoeff(),
      kPoseRounding);
}

void expectEqual(const CompleteMeasurement& a, const CompleteMeasurement& b)
{
  expectEqual(a.object_sensor.pose(), b.object_sensor.pose());
  EXPECT_EQ(a.object_sensor.semiAxes(), b.object_sensor.semiAxes());
  for (std::size_t i = 0; i < kFaces; ++i)
  {
    EXPECT_EQ(a.faces[i].kind, b.faces[i].kind) << i;
    EXPECT_EQ(a.faces[i].sigma, b.faces[i].sigma) << i;
  }
  EXPECT_EQ(a.yawDefined, b.yawDefined);
  EXPECT_EQ(a.yawSigma, b.yawSigma);
  EXPECT_EQ(a.yawDominance, b.yawDominance);
}

void expectEqual(const ObjectMeasurement& a, const ObjectMeasurement& b)
{
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.projectedIoU, b.projectedIoU);
  EXPECT_EQ(a.depthCoverage, b.depthCoverage);
  EXPECT_EQ(a.seed_sensor, b.seed_sensor);
  ASSERT_EQ(a.complete.has_value(), b.complete.has_value());
  if (a.complete) expectEqual(*a.complete, *b.complete);
  ASSERT_EQ(a.edges.has_value(), b.edges.has_value());
  if (!a.edges) return;
  for (std::size_t i = 0; i < a.edges->size(); ++i)
  {
    const EdgeMeasurement &edgeA = (*a.edges)[i], &edgeB = (*b.edges)[i];
    EXPECT_EQ(edgeA.plane_sensor.n, edgeB.plane_sensor.n) << i;
    EXPECT_EQ(edgeA.plane_sensor.d, edgeB.plane_sensor.d) << i;
    EXPECT_EQ(edgeA.sigmaAngle, edgeB.sigmaAngle) << i;
    EXPECT_EQ(edgeA.state, edgeB.state) << i;
  }
}

void expectEqual(const DetectedObject& a, const DetectedObject& b)
{
  EXPECT_EQ(a.label, b.label);
  EXPECT_EQ(a.score, b.score);
  EXPECT_EQ(a.box.x1, b.box.x1);
  EXPECT_EQ(a.box.y1, b.box.y1);
  EXPECT_EQ(a.box.x2, b.box.x2);
  EXPECT_EQ(a.box.y2, b.box.y2);
  EXPECT_EQ(a.instanceId, b.instanceId);
  ASSERT_EQ(a.mask.has_value(), b.mask.has_value());
  if (a.mask)
  {
    EXPECT_EQ(a.mask->x0, b.mask->x0);
    EXPECT_EQ(a.mask->y0, b.mask->y0);
    EXPECT_EQ(a.mask->width, b.mask->width);
    EXPECT_EQ(a.mask->height, b.mask->height);
    EXPECT_EQ(a.mask->pixels, b.mask->pixels);
  }
  expectEqual(a.measurement, b.measurement);
}

void expectEqual(const CObservationObjects& a, const CObservationObjects& b)
{
  EXPECT_EQ(a.timestamp, b.timestamp);
  EXPECT_EQ(a.sensorLabel, b.sensorLabel);
  expectEqual(a.sensorPose, b.sensorPose);
  EXPECT_EQ(a.cameraParams.ncols, b.cameraParams.ncols);
  EXPECT_EQ(a.cameraParams.nrows, b.cameraParams.nrows);
  EXPECT_EQ(a.cameraParams.intrinsicParams, b.cameraParams.intrinsicParams);
  EXPECT_EQ(a.cameraParams.distortion, b.cameraParams.distortion);
  EXPECT_EQ(a.cameraParams.dist, b.cameraParams.dist);
  EXPECT_EQ(a.cameraParams.focalLengthMeters, b.cameraParams.focalLengthMeters);
  EXPECT_EQ(a.cameraParams.cameraName, b.cameraParams.cameraName);
  EXPECT_EQ(a.coarseDepth.columns, b.coarseDepth.columns);
  EXPECT_EQ(a.coarseDepth.rows, b.coarseDepth.rows);
  EXPECT_EQ(a.coarseDepth.depth, b.coarseDepth.depth);
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) expectEqual(a.objects[i], b.objects[i]);
}

std::string bytesOf(const CObservationObjects& obs)
{
  mrpt::io::CMemoryStream stream;
  auto archive = archiveFrom(stream);
  archive << obs;
  return std::string(
      static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount());
}

mrpt::serialization::CSerializable::Ptr objectFrom(const std::string& bytes)
{
  mrpt::io::CMemoryStream stream(bytes.data(), bytes.size());
  auto archive = archiveFrom(stream);
  return archive.ReadObject();
}

CObservationObjects::Ptr readBack(const CObservationObjects& obs)
{
  return std::dynamic_pointer_cast<CObservationObjects>(objectFrom(bytesOf(obs)));
}

}  // namespace

TEST(CObservationObjects, EveryFieldSurvivesAnArchive)
{
  const auto obs = sampleObservation();
  const auto copy = readBack(obs);
  ASSERT_TRUE(copy);
  expectEqual(obs, *copy);
}

TEST(CObservationObjects, ReadingReplacesWhatWasThere)
{
  const auto obs = sampleObservation();
  mrpt::io::CMemoryStream stream;
  auto archive = archiveFrom(stream);
  archive << obs;
  stream.Seek(0);
  CObservationObjects filled = sampleObservation();
  filled.objects[0].label = "old";
  archive >> filled;
  expectEqual(obs, filled);
}

TEST(CObservationObjects, SurvivesACompressedRawlogOfObservations)
{
  const TemporaryFolder folder;
  const auto obs = sampleObservation();
  {
    mrpt::obs::CRawlog rawlog;
    rawlog.insert(CObservationObjects::Create(obs));
    rawlog.insert(CObservationObjects::Create());
    ASSERT_TRUE(rawlog.saveToRawLogFile(folder.path("a.objects.rawlog")));
  }
  mrpt::obs::CRawlog rawlog;
  ASSERT_TRUE(rawlog.loadFromRawLogFile(folder.path("a.objects.rawlog")));
  ASSERT_EQ(rawlog.size(), 2u);
  const auto copy = std::dynamic_pointer_cast<CObservationObjects>(rawlog.getAsObservation(0));
  ASSERT_TRUE(copy);
  expectEqual(obs, *copy);
  const auto empty = std::dynamic_pointer_cast<CObservationObjects>(rawlog.getAsObservation(1));
  ASSERT_TRUE(empty);
  EXPECT_TRUE(empty->objects.empty());
  EXPECT_TRUE(empty->coarseDepth.empty());
}

TEST(CObservationObjects, SurvivesASensoryFrame)
{
  const auto obs = sampleObservation();
  mrpt::obs::CSensoryFrame frame;
  frame.insert(CObservationObjects::Create(obs));
  mrpt::io::CMemoryStream stream;
  auto archive = archiveFrom(stream);
  archive << frame;
  stream.Seek(0);
  mrpt::obs::CSensoryFrame copy;
  archive >> copy;
  const auto first = copy.getObservationByClass<CObservationObjects>();
  ASSERT_TRUE(first);
  expectEqual(obs, *first);
}

TEST(CObservationObjects, BadBoxesOfADetectorAreCarriedAsTheyAre)
{
  CObservationObjects obs;
  obs.objects.resize(1);
  obs.objects[0].score = std::numeric_limits<double>::quiet_NaN();
  obs.objects[0].box = {NAN, 5, INFINITY, -5};
  const auto copy = readBack(obs);
  ASSERT_TRUE(copy);
  EXPECT_TRUE(std::isnan(copy->objects.at(0).score));
  EXPECT_TRUE(std::isnan(copy->objects[0].box.x1));
  EXPECT_EQ(copy->objects[0].box.x2, INFINITY);
  EXPECT_EQ(copy->objects[0].box.y2, -5);
  EXPECT_FALSE(copy->objects[0].box.isValid());
  std::ostringstream text;
  EXPECT_NO_THROW(copy->getDescriptionAsText(text));
  EXPECT_NE(copy->exportTxtDataRow().find("nan"), std::string::npos);
}

TEST(CObservationObjects, MasksOfAllShapesSurvive)
{
  using Pixels = std::vector<std::uint8_t>;
  std::vector<ObjectMask> masks;
  masks.push_back({5, 6, 0, 0, Pixels()});
  masks.push_back({5, 6, 1, 1, Pixels(1, 0)});
  masks.push_back({5, 6, 1, 1, Pixels(1, 1)});
  masks.push_back({
      5, 6, 3, 2, Pixels{1, 0, 1, 0, 1, 0}
  });
  masks.push_back({
      5, 6, 2, 2, Pixels{0, 0, 0, 1}
  });
  masks.push_back({5, 6, 300, 300, Pixels(90000, 1)});
  for (const auto& mask : masks)
  {
    CObservationObjects obs;
    obs.objects.resize(1);
    obs.objects[0].mask = mask;
    const auto copy = readBack(obs);
    ASSERT_TRUE(copy);
    ASSERT_TRUE(copy->objects.at(0).mask);
    EXPECT_EQ(copy->objects[0].mask->pixels, mask.pixels) << mask.width << "x" << mask.height;
  }
}

TEST(CObservationObjects, MasksAreStoredCompactly)
{
  CObservationObjects obs;
  obs.objects.resize(1);
  const auto without = bytesOf(obs).size();
  obs.objects[0].mask = ObjectMask{0, 0, 640, 480, std::vector<std::uint8_t>(640 * 480, 1)};
  EXPECT_LT(bytesOf(obs).size() - without, 32u) << "four numbers and two run lengths";
}

TEST(CObservationObjects, AnUnknownVersionIsRefused)
{
  // Stream of an object: length of the class name | 0x80, name, version, ...
  std::string bytes = bytesOf(sampleObservation());
  const std::size_t nameLength = static_cast<std::uint8_t>(bytes[0]) & 0x7f;
  ASSERT_EQ(bytes.substr(1, nameLength), "quadmap::CObservationObjects");
  ASSERT_EQ(bytes[1 + nameLength], 0);
  bytes[1 + nameLength] = 1;
  EXPECT_NE(errorOf([&] { objectFrom(bytes); }).find("version"), std::string::npos);
}

TEST(CObservationObjects, EveryTruncationIsAnError)
{
  const std::string bytes = bytesOf(sampleObservation());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_NE(errorOf([&] { objectFrom(bytes.substr(0, size)); }), "") << size << " bytes";
}

TEST(CObservationObjects, AMaskThatIsTooShortOrTooLargeCannotBeWritten)
{
  CObservationObjects obs;
  obs.objects.resize(1);
  obs.objects[0].mask = ObjectMask{
      0, 0, 4, 4, {1, 1}
  };
  EXPECT_NE(errorOf([&] { bytesOf(obs); }).find("mask"), std::string::npos);
  obs.objects[0].mask = ObjectMask{0, 0, 70000, 1, std::vector<std::uint8_t>(70000)};
  EXPECT_NE(errorOf([&] { bytesOf(obs); }).find("mask"), std::string::npos);
}

TEST(CObservationObjects, MeasurementsThatBreakTheirContractCannotBeWritten)
{
  const std::vector<std::pair<std::string, void (*)(ObjectMeasurement&)>> cases = {
      { "cuboid",                     [](ObjectMeasurement& m) { m.complete.reset(); }},
      { "cuboid",      [](ObjectMeasurement& m) { m.kind = MeasurementKind::Partial; }},
      {  "edges",                        [](ObjectMeasurement& m) { m.edges.reset(); }},
      {"quality",                   [](ObjectMeasurement& m) { m.projectedIoU = NAN; }},
      {"quality",             [](ObjectMeasurement& m) { m.depthCoverage = INFINITY; }},
      {   "seed",               [](ObjectMeasurement& m) { m.seed_sensor->y() = NAN; }},
      {  "sigma",       [](ObjectMeasurement& m) { m.complete->faces[2].sigma = NAN; }},
      {  "sigma",              [](ObjectMeasurement& m) { m.complete->yawSigma = -1; }},
      {   "edge", [](ObjectMeasurement& m) { (*m.edges)[1].plane_sensor.n.x() = NAN; }},
      {   "edge",    [](ObjectMeasurement& m) { (*m.edges)[3].sigmaAngle = INFINITY; }}
  };
  for (std::size_t i = 0; i < cases.size(); ++i)
  {
    CObservationObjects obs = sampleObservation();
    cases[i].second(obs.objects[0].measurement);
    const auto error = errorOf([&] { bytesOf(obs); });
    EXPECT_NE(error.find(cases[i].first), std::string::npos) << "case " << i << ": " << error;
  }
}

TEST(CObservationObjects, ASensorPoseThatIsNotFiniteCannotBeWritten)
{
  CObservationObjects obs;
  obs.sensorPose.x(NAN);
  EXPECT_NE(errorOf([&] { bytesOf(obs); }).find("pose"), std::string::npos);
}

TEST(CObservationObjects, TheDescriptionNamesObjectsAndMeasurements)
{
  std::ostringstream o;
  sampleObservation().getDescriptionAsText(o);
  const std::string text = o.str();
  for (const char* part :
       {"camera", "Objects: 4", "dining table score 0.88", "instance 7", "mask 40x30",
        "complete (projected cuboid fits the box)", "center (2.000, -0.100, 0.300) m",
        "size 0.600 x 0.400 x 0.900 m", "partial", "rejected (box fills the image)", "320x240"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
}

TEST(CObservationObjects, TheTextRowHasAsManyColumnsAsTheHeaderSays)
{
  const auto wordsOf = [](const std::string& text)
  {
    std::istringstream s(text);
    return std::vector<std::string>(std::istream_iterator<std::string>(s), {});
  };
  const auto obs = sampleObservation();
  ASSERT_TRUE(obs.exportTxtSupported());
  const auto header = obs.exportTxtHeader();
  const auto perImage = wordsOf(header.substr(0, header.find(','))).size();
  const auto perObject = wordsOf(header.substr(header.find(':') + 1)).size();
  const auto row = wordsOf(obs.exportTxtDataRow());
  ASSERT_EQ(row.size(), perImage + obs.objects.size() * perObject);
  EXPECT_EQ(row[0], "320");
  EXPECT_EQ(row[2], "4");
  EXPECT_EQ(row[3], "dining_table") << "one word";
  EXPECT_EQ(row[3 + perObject], "cup");
  EXPECT_EQ(row[3 + 7], "complete");
  EXPECT_EQ(row[3 + perObject + 7], "partial");
  EXPECT_EQ(obs.exportTxtDataRow().find('\n'), std::string::npos);
}

TEST(CObservationObjects, SensorPoseIsReachedThroughTheBaseClass)
{
  CObservationObjects obs;
  mrpt::obs::CObservation& base = obs;
  base.setSensorPose(mrpt::poses::CPose3D(1, 2, 3, 0.1, 0.2, 0.3));
  mrpt::poses::CPose3D pose;
  base.getSensorPose(pose);
  expectEqual(pose, obs.sensorPose);
}

TEST(PinholeFrom, TakesTheCalibrationAndImageSize)
{
  const auto camera = pinholeFrom(sampleObservation().cameraParams);
  EXPECT_EQ(camera.fx, 262.5);
  EXPECT_EQ(camera.fy, -261.5) << "a negative fy is legal";
  EXPECT_EQ(camera.cx, 159.5);
  EXPECT_EQ(camera.cy, 119.25);
  EXPECT_EQ(camera.width, 320u);
  EXPECT_EQ(camera.height, 240u);
}

TEST(ObjectMask, ContainsOnlyItsOwnPixels)
{
  const auto mask = sampleMask();
  EXPECT_TRUE(mask.contains(31, 37)) << "the disk's centre";
  EXPECT_FALSE(mask.contains(11, 22)) << "its rectangle's corner";
  EXPECT_FALSE(mask.contains(10, 37));
  EXPECT_FALSE(mask.contains(51, 37));
  EXPECT_FALSE(mask.contains(31, 52));
}

TEST(MaskPixels, AreThoseThatWereAdded)
{
  std::mt19937 random(7);
  std::vector<std::uint8_t> expected;
  MaskPixels pixels;
  EXPECT_EQ(pixels.size(), 0u);
  for (int i = 0; i < 200; ++i)
  {
    const auto count = static_cast<std::uint32_t>(random() % 5);
    const bool pixel = random() % 3 == 0;
    pixels.append(count, pixel);
    expected.insert(expected.end(), count, pixel);
    ASSERT_EQ(pixels.size(), expected.size());
    ASSERT_EQ(pixels.expanded(), expected);
    ASSERT_EQ(pixels, MaskPixels(expected));
  }
  for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_EQ(pixels[i], expected[i] != 0) << i;
  EXPECT_TRUE(pixels.hasOnes());
  EXPECT_FALSE(MaskPixels({0, 0}).hasOnes());
  EXPECT_FALSE(MaskPixels().hasOnes());
}

TEST(CObservationObjects, LimitsTheObjectsAndMasksOfAnImage)
{
  const auto copyOf = [](const CObservationObjects& original)
  {
    mrpt::io::CMemoryStream stream;
    auto archive = mrpt::serialization::archiveFrom(stream);
    archive << original;
    stream.Seek(0);
    CObservationObjects copy;
    archive >> copy;
  };
  CObservationObjects boxes;
  boxes.objects.resize(CObservationObjects::kMostObjects);
  EXPECT_EQ(errorOf([&] { copyOf(boxes); }), "");
  boxes.objects.emplace_back();
  EXPECT_NE(errorOf([&] { copyOf(boxes); }).find("too many objects"), std::string::npos);

  ObjectMask mask;
  mask.width = mask.height = 4096;
  mask.pixels.append(4096 * 4096, false);
  boxes.objects.assign(4, {});
  for (auto& object : boxes.objects) object.mask = mask;
  EXPECT_EQ(errorOf([&] { copyOf(boxes); }), "") << "64 MB together";
  boxes.objects.push_back(boxes.objects[0]);
  EXPECT_NE(errorOf([&] { copyOf(boxes); }).find("masks"), std::string::npos);

  mask.pixels = {};
  mask.width = mask.height = 1024;
  for (int i = 0; i < 1024 * 1024; ++i) mask.pixels.push_back(i % 2 != 0);
  boxes.objects.assign(1, {});
  boxes.objects[0].mask = mask;
  EXPECT_EQ(errorOf([&] { copyOf(boxes); }), "") << "a million runs";
  boxes.objects.push_back(boxes.objects[0]);
  EXPECT_NE(errorOf([&] { copyOf(boxes); }).find("too many runs"), std::string::npos);
}

TEST(CObservationObjects, LimitsTheTextsOfAnImage)
{
  const auto bytesOf = [](const CObservationObjects& boxes)
  {
    const auto bytes = archiveBytes(boxes);
    return std::string(bytes.begin(), bytes.end());
  };
  CObservationObjects boxes;
  const std::string none = bytesOf(boxes);
  boxes.objects.resize(1);
  boxes.objects[0].label = std::string(60000, 'a');
  boxes.objects[0].measurement.reason = std::string(4000, 'b');
  const std::string one = bytesOf(boxes);
  // The objects stand behind their number (4 bytes) and before the mark of the end (1 byte).
  const std::string object = one.substr(none.size() - 1, one.size() - none.size());
  const auto readCopies = [&](char count)
  {
    std::string bytes = none.substr(0, none.size() - 5) + count + std::string(3, '\0');
    for (char i = 0; i < count; i = static_cast<char>(i + 1)) bytes += object;
    bytes += '\x88';
    mrpt::io::CMemoryStream stream(bytes.data(), bytes.size());
    CObservationObjects copy;
    mrpt::serialization::archiveFrom(stream) >> copy;
    return copy.objects.size();
  };
  EXPECT_EQ(readCopies(4), 4U) << "256 kB together";
  EXPECT_NE(errorOf([&] { readCopies(5); }), "");
  boxes.objects.resize(5, boxes.objects[0]);
  EXPECT_NE(errorOf([&] { bytesOf(boxes); }).find("labels and reasons"), std::string::npos)
      << "what cannot be read is not written";
}
