#pragma once

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/io/CFileOutputStream.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "../obs/FileSizeLimit.h"
#include "../obs/TemporaryFolder.h"
#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/sensors/RawlogSource.h"

namespace quadmap
{
constexpr int kColumns = 64, kRows = 48;  // size of the sample images [px]
constexpr double kStart = 1000.0;         // time of the first sample [s]

inline mrpt::Clock::time_point stamp(double time) { return mrpt::Clock::fromDouble(time); }

/** A scan of a slope of depths in millimetres, with a gradient of colours. It is small, so that
 * tests are quick. */
inline mrpt::obs::CObservation3DRangeScan::Ptr sampleScan(
    double time, const std::string& label = "camera")
{
  auto scan = mrpt::obs::CObservation3DRangeScan::Create();
  scan->timestamp = stamp(time);
  scan->sensorLabel = label;
  scan->cameraParams.ncols = kColumns;
  scan->cameraParams.nrows = kRows;
  scan->cameraParams.setIntrinsicParamsFromValues(60, 62, 31.5, 23.5);
  scan->cameraParamsIntensity = scan->cameraParams;
  scan->hasRangeImage = scan->hasIntensityImage = true;
  scan->rangeUnits = 0.001f;
  scan->rangeImage_setSize(kRows, kColumns);
  scan->intensityImage.resize(kColumns, kRows, mrpt::img::CH_RGB);
  for (int v = 0; v < kRows; ++v)
    for (int u = 0; u < kColumns; ++u)
    {
      scan->rangeImage(v, u) = static_cast<std::uint16_t>(1000 + 3 * u + v);
      for (std::int8_t channel = 0; channel < 3; ++channel)
        scan->intensityImage.at<std::uint8_t>(u, v, channel) = static_cast<std::uint8_t>(4 * u);
    }
  return scan;
}

/** Two boxes that fit sampleScan(). */
inline CObservationObjects::Ptr sampleBoxes(double time, const std::string& label = "camera")
{
  auto boxes = CObservationObjects::Create();
  boxes->timestamp = stamp(time);
  boxes->sensorLabel = label;
  boxes->cameraParams = sampleScan(time)->cameraParams;
  boxes->objects.resize(2);
  boxes->objects[0].label = "chair";
  boxes->objects[0].score = 0.75;
  boxes->objects[0].box = {10, 12, 30, 40};
  boxes->objects[1].label = "cup";
  boxes->objects[1].box = {-3, 20, 8, 28};  // reaches over the border, and can be used
  return boxes;
}

inline mrpt::obs::CObservationRobotPose::Ptr samplePose(
    double time, const mrpt::poses::CPose3D& pose, const std::string& label = "odometry")
{
  auto o = mrpt::obs::CObservationRobotPose::Create();
  o->timestamp = stamp(time);
  o->sensorLabel = label;
  o->pose.mean = pose;
  return o;
}

/** Writes objects as any MRPT program does. \return The path. */
inline std::string writeObjects(
    const std::string& path,
    const std::vector<mrpt::serialization::CSerializable::Ptr>& objects,
    bool compressed = true)
{
  const auto write = [&](auto&& stream)
  {
    auto archive = mrpt::serialization::archiveFrom(stream);
    for (const auto& object : objects) archive << *object;
  };
  if (compressed)
    write(mrpt::io::CFileGZOutputStream(path));
  else
    write(mrpt::io::CFileOutputStream(path));
  return path;
}

/** Reads all frames. */
inline std::vector<RgbdFrame> readAll(RawlogSource& source)
{
  std::vector<RgbdFrame> frames;
  while (auto frame = source.next()) frames.push_back(*frame);
  return frames;
}

inline std::vector<RgbdFrame> readAll(const std::string& path, RawlogSourceOptions options = {})
{
  RawlogSource source(path, options);
  return readAll(source);
}

}  // namespace quadmap
