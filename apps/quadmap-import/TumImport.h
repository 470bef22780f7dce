#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "quadmap/sensors/RawlogWriter.h"
#include "quadmap/sensors/TumDataset.h"

namespace quadmap
{
/** What the poses of a recording become in the rawlog. */
enum class PosesAs
{
  Odometry,
  GroundTruth,
  None
};

struct TumImportOptions
{
  PosesAs posesAs = PosesAs::Odometry;
  std::size_t every = 1;   //!< Every n-th frame only, >= 1
  bool keepGoing = false;  //!< Drop frames and boxes that cannot be used instead of throwing
};

struct TumImportReport
{
  std::size_t frames = 0, poses = 0, boxes = 0;  //!< Written
  std::vector<std::string> dropped;              //!< With keepGoing: one text each
};

/** Called with the share done, in [0, 1]. */
using ProgressCallback = std::function<void(double)>;

/** Writes a recording into a rawlog; the caller finishes it.
 * \exception std::runtime_error What is wrong with a frame; names its file. */
TumImportReport importTum(
    const TumDataset& dataset,
    const TumImportOptions& options,
    RawlogWriter& writer,
    const ProgressCallback& progress);

}  // namespace quadmap
