#pragma once

#include <vector>

#include "../../sensors/SampleRawlog.h"

namespace quadmap
{
/** The first images of the bundled rawlog, with odometry and true poses. The scans are deep copies,
 * which tests may spoil. */
inline std::vector<RgbdFrame> homeFrames(std::size_t count)
{
  static const std::vector<RgbdFrame> all = []
  {
    constexpr std::size_t kMost = 60;
    std::vector<RgbdFrame> frames;
    RawlogSource source(QUADMAP_SOURCE_DIR "/rawlogs/home.rawlog", {});
    while (frames.size() < kMost) frames.push_back(source.next().value());
    return frames;
  }();
  std::vector<RgbdFrame> frames(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
  for (auto& frame : frames)
  {
    frame.scan = mrpt::obs::CObservation3DRangeScan::Create(*frame.scan);
    frame.scan->intensityImage = frame.scan->intensityImage.makeDeepCopy();
  }
  return frames;
}

/** Makes the image black and without depth, as with a hand in front of the lens. */
inline void cover(RgbdFrame& frame)
{
  auto& image = frame.scan->intensityImage;
  image.filledRectangle(
      0, 0, static_cast<int>(image.getWidth()) - 1, static_cast<int>(image.getHeight()) - 1,
      mrpt::img::TColor(0, 0, 0));
  frame.scan->rangeImage.setZero();
}

}  // namespace quadmap
