#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cstring>

#include "RawlogProblems.h"

namespace quadmap
{
constexpr std::uint32_t kRays = 1234;  // stated once in a file of the samples below

inline mrpt::obs::CObservation2DRangeScan::Ptr sampleRays(double time)
{
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->timestamp = stamp(time);
  scan->sensorLabel = "laser";
  scan->resizeScan(kRays);
  for (std::size_t i = 0; i < kRays; ++i) scan->setScanRange(i, 1.5f);
  return scan;
}

inline std::string bytesOf(std::uint32_t number)
{
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

/** The bytes of two images, a laser scan between them, and a pose behind. */
inline std::string recordedBytes(const TemporaryFolder& folder)
{
  return readFile(writeObjects(
      folder.path("x.rawlog"),
      {sampleScan(kStart), sampleRays(kStart), sampleScan(kStart + 1), samplePose(kStart + 1, {})},
      false));
}

/** The file with another count of rays. */
inline std::string withRays(const TemporaryFolder& folder, std::uint32_t count)
{
  std::string bytes = recordedBytes(folder);
  const auto at = bytes.find(bytesOf(kRays), bytes.find("CObservation2DRangeScan"));
  EXPECT_LT(at, bytes.size());
  return folder.write("x.rawlog", bytes.replace(at, sizeof count, bytesOf(count)));
}
}  // namespace quadmap
