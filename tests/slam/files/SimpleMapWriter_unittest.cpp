#include "files/SimpleMapWriter.h"

#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <sys/wait.h>

#include <Eigen/Dense>
#include <cstdlib>
#include <filesystem>

#include "../SyntheticRoom.h"
#include "quadmap/base/GzipStream.h"

using namespace quadmap;
using mrpt::obs::CObservation3DRangeScan;
using mrpt::poses::CPose3D;
using mrpt::poses::CPose3DPDFGaussian;

namespace
{
/** Three keyframes, of which no detector looked at the second. */
class SimpleMapWriter : public ::testing::Test
{
 protected:
  SimpleMapWriter() : spool_(folder_.folder().string())
  {
    for (int i = 0; i < 3; ++i)
    {
      const auto pose = room_.robotAt(0.3 * i);
      scans_.push_back(room_.scanFrom(pose, kStart + i));
      boxes_.push_back(i == 1 ? nullptr : room_.boxesOf(*scans_.back(), pose));
      spool_.append(*scans_.back(), boxes_.back().get());
      keyframes_.push_back({static_cast<std::size_t>(i), "camera", kStart + i, pose, pose});
    }
  }

  std::vector<CPose3DPDFGaussian> poses() const
  {
    return poseDistributions(poseNodesOf(keyframes_), keyframes_, {options_, PoseSource::Auto});
  }

  mrpt::maps::CSimpleMap written(SimpleMapContent content)
  {
    const auto path = folder_.path("x.simplemap");
    writeSimpleMap(path, poseNodesOf(keyframes_), spool_, content, poses());
    mrpt::maps::CSimpleMap map;
    EXPECT_TRUE(map.loadFromFile(path));
    return map;
  }

  SyntheticRoom room_;
  TemporaryFolder folder_;
  KeyframeSpool spool_;
  PoseUncertaintyOptions options_;
  std::vector<CObservation3DRangeScan::Ptr> scans_;
  std::vector<CObservationObjects::Ptr> boxes_;
  std::vector<Keyframe> keyframes_;
};
}  // namespace

TEST_F(SimpleMapWriter, StockClassReadsPosesAndScans)
{
  const auto map = written(SimpleMapContent::Scans);
  ASSERT_EQ(map.size(), 3u);
  PoseCovarianceChain covariances(options_, PoseSource::Auto);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto [pose, frame] = map.get(i);
    const auto gaussian = std::dynamic_pointer_cast<const mrpt::poses::CPose3DPDFGaussian>(pose);
    ASSERT_TRUE(gaussian);
    const auto expected = covariances.next(keyframes_[i].T_map_robot);
    EXPECT_LT((gaussian->mean - expected.mean).norm(), 1e-12);
    EXPECT_TRUE(gaussian->cov.asEigen().isApprox(expected.cov.asEigen(), 1e-12));
    ASSERT_EQ(frame->size(), 1u);
    const auto scan = frame->getObservationByClass<CObservation3DRangeScan>();
    ASSERT_TRUE(scan);
    EXPECT_EQ(scan->rangeImage, scans_[i]->rangeImage);
    EXPECT_EQ(scan->timestamp, scans_[i]->timestamp);
    EXPECT_EQ(scan->sensorPose, scans_[i]->sensorPose);
    EXPECT_EQ(scan->cameraParams, scans_[i]->cameraParams);
    EXPECT_FALSE(scan->hasPoints3D);
    const int before = scans_[i]->intensityImage.at<std::uint8_t>(160, 120, 1);
    EXPECT_NEAR(scan->intensityImage.at<std::uint8_t>(160, 120, 1), before, 6) << "JPEG";
  }
}

TEST_F(SimpleMapWriter, EqualsWhatTheStockClassWouldHaveWritten)
{
  const auto map = written(SimpleMapContent::Objects);
  mrpt::maps::CSimpleMap reference;
  PoseCovarianceChain covariances(options_, PoseSource::Auto);
  for (std::size_t i = 0; i < 3; ++i)
  {
    mrpt::obs::CSensoryFrame frame;
    if (boxes_[i]) frame.insert(boxes_[i]);
    reference.insert(covariances.next(keyframes_[i].T_map_robot), frame);
  }
  EXPECT_EQ(archiveBytes(map), archiveBytes(reference));
}

TEST_F(SimpleMapWriter, PosesHaveTheCovariancesOfTheEstimation)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    auto& covariance = keyframes_[i].covariance.emplace();
    for (int row = 0; row < 6; ++row)
      covariance(row, row) = 1e-4 * (1 + row + 6 * static_cast<int>(i));
    covariance(0, 5) = covariance(5, 0) = 1e-5;
  }
  const auto covarianceOf = [&](std::size_t i)
  {
    const auto [pose, frame] = written(SimpleMapContent::Objects).get(i);
    return std::dynamic_pointer_cast<const CPose3DPDFGaussian>(pose)->cov;
  };
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(covarianceOf(i), *keyframes_[i].covariance);

  keyframes_[1].covariance = std::nullopt;  // then all are of one kind
  PoseCovarianceChain chain(options_, PoseSource::Auto);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(covarianceOf(i), chain.next(keyframes_[i].T_map_robot).cov);
}

TEST_F(SimpleMapWriter, CamerasOfOnePoseShareAFrame)
{
  const auto pose = keyframes_[1].T_map_robot;
  const auto scan = room_.scanFrom(pose, kStart + 1.02);
  scan->sensorLabel = "rear";
  spool_.append(*scan, room_.boxesOf(*scan, pose).get());
  keyframes_.push_back({3, "rear", kStart + 1.02, pose, pose});

  const auto scans = written(SimpleMapContent::Scans);
  ASSERT_EQ(scans.size(), 3u);
  const auto frame = std::get<1>(scans.get(1));
  ASSERT_EQ(frame->size(), 2u);
  EXPECT_EQ(frame->getObservationByIndex(0)->sensorLabel, "camera");
  EXPECT_EQ(frame->getObservationByIndex(1)->sensorLabel, "rear");
  EXPECT_EQ(frame->getObservationByIndex(1)->timestamp, scan->timestamp);
  const auto boxes = written(SimpleMapContent::Objects);
  ASSERT_EQ(std::get<1>(boxes.get(1))->size(), 1u) << "nobody looked in the other image";
  EXPECT_EQ(std::get<1>(boxes.get(1))->getObservationByIndex(0)->sensorLabel, "rear");
}

TEST_F(SimpleMapWriter, AScanOfSeveralMembersComesBack)
{
  auto& scan = *scans_[0];
  scan.rangeImage_setSize(3000, 4000);  // 24 MB
  scan.cameraParams.nrows = 3000;
  scan.cameraParams.ncols = 4000;
  std::uint32_t noise = 1;
  for (int v = 0; v < scan.rangeImage.rows(); ++v)
    for (int u = 0; u < scan.rangeImage.cols(); ++u)
      scan.rangeImage(v, u) = static_cast<std::uint16_t>((noise = noise * 1664525 + 1) >> 16);
  spool_.append(scan, nullptr);
  EXPECT_GT(spool_.scanMembers(3).size(), 16u << 20) << "more than the bytes of a member";
  keyframes_.push_back({3, "camera", kStart + 3, keyframes_[2].T_map_robot + CPose3D(1, 0, 0), {}});
  const auto map = written(SimpleMapContent::Scans);
  ASSERT_EQ(map.size(), 4u);
  const auto read = std::get<1>(map.get(3))->getObservationByClass<CObservation3DRangeScan>();
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->rangeImage == scan.rangeImage);
}

TEST_F(SimpleMapWriter, EmptyMapIsAMapToo)
{
  keyframes_.clear();
  EXPECT_EQ(written(SimpleMapContent::Scans).size(), 0u);
}

TEST_F(SimpleMapWriter, ObservationsToMapReadsIt)
{
  if (std::system("command -v observations2map >/dev/null") != 0)
    GTEST_SKIP() << "observations2map (Debian: mrpt-apps) is not installed";
  written(SimpleMapContent::Scans);
  const auto ini = folder_.write("x.ini", "[MappingApplication]\npointsMap_count=1\n");
  const std::string command = "observations2map " + ini + " " + folder_.path("x.simplemap") + " " +
                              folder_.path("out") + " </dev/null >" + folder_.path("log") + " 2>&1";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_NE(readFile(folder_.path("log")).find("done: 3 observations"), std::string::npos)
      << readFile(folder_.path("log"));
}

TEST_F(SimpleMapWriter, FullDiskIsAnErrorAndLeavesNothing)
{
  const auto before = folder_.fileCount();
  const FileSizeLimit limit(1000);
  const auto path = folder_.path("x.simplemap");
  const std::string error = errorOf(
      [&]
      { writeSimpleMap(path, poseNodesOf(keyframes_), spool_, SimpleMapContent::Scans, poses()); });
  EXPECT_EQ(error.find(path + ": cannot be written"), 0u) << error;
  EXPECT_EQ(folder_.fileCount(), before);
}

TEST(KeyframeSpool, GivesBoxesBackAndLeavesNoFile)
{
  const TemporaryFolder folder;
  const SyntheticRoom room;
  const auto pose = room.robotAt(0);
  const auto scan = room.scanFrom(pose, kStart);
  {
    KeyframeSpool spool(folder.folder().string());
    spool.append(*scan, room.boxesOf(*scan, pose).get());
    spool.append(*scan, nullptr);
    EXPECT_EQ(spool.size(), 2u);
    ASSERT_TRUE(spool.objects(0));
    EXPECT_EQ(spool.objects(0)->objects.at(0).label, room.label);
    EXPECT_FALSE(spool.objects(1));
    EXPECT_EQ(folder.fileCount(), 0u) << "a crash must not leave anything either";
  }
}

TEST(KeyframeSpool, EmbedsExternalImages)
{
  const TemporaryFolder folder;
  const SyntheticRoom room;
  auto scan = room.scanFrom(room.robotAt(0), kStart);
  ASSERT_TRUE(scan->intensityImage.saveToFile(folder.path("x.png")));
  const int before = scan->intensityImage.at<std::uint8_t>(10, 200, 0);
  scan->intensityImage.setExternalStorage(folder.path("x.png"));
  scan->rangeImage_convertToExternalStorage("x.bin", folder.folder().string() + "/");
  scan->rangeImage = room.scanFrom(room.robotAt(0), kStart)->rangeImage;

  KeyframeSpool spool(folder.folder().string());
  spool.append(*scan, nullptr);
  EXPECT_TRUE(scan->intensityImage.isExternallyStored()) << "the caller's scan is left alone";
  std::filesystem::remove(folder.path("x.png"));
  std::filesystem::remove(folder.path("x.bin"));
  writeSimpleMap(
      folder.path("x.simplemap"), poseNodesOf({Keyframe()}), spool, SimpleMapContent::Scans,
      {CPose3DPDFGaussian()});
  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile(folder.path("x.simplemap")));
  const auto stored = std::get<1>(map.get(0))->getObservationByClass<CObservation3DRangeScan>();
  EXPECT_FALSE(stored->intensityImage.isExternallyStored());
  EXPECT_FALSE(stored->rangeImage_isExternallyStored());
  EXPECT_EQ(stored->rangeImage, scan->rangeImage);
  EXPECT_NEAR(stored->intensityImage.at<std::uint8_t>(10, 200, 0), before, 6) << "JPEG";
}

TEST(KeyframeSpool, MissingFolderIsAnError)
{
  EXPECT_NE(errorOf([] { KeyframeSpool("/nonexistent"); }).find("/nonexistent"), std::string::npos);
}
