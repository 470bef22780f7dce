#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "TestCamera.h"
#include "quadmap/sensors/RawlogSource.h"

namespace quadmap
{
/** A camera that shows the first frames of a recording. */
inline TestCamera cameraOf(const std::string& rawlog, int frames)
{
  TestCamera camera;
  RawlogSource source(rawlog, {});
  while (camera.frames < frames)
  {
    const auto frame = source.next();
    if (!frame) throw std::runtime_error(rawlog + " has too few frames");
    const auto& scan = *frame->scan;
    const auto& c = scan.cameraParams;
    camera.width = static_cast<int>(c.ncols);
    camera.height = static_cast<int>(c.nrows);
    camera.horizontalFov = 2 * std::atan(0.5 * c.ncols / c.fx());
    camera.verticalFov = 2 * std::atan(0.5 * c.nrows / c.fy());
    const auto at = camera.images.size();
    camera.images.resize(at + camera.depthBytes() + camera.colorBytes());
    auto* depth = reinterpret_cast<std::uint16_t*>(camera.images.data() + at);
    auto* color = camera.images.data() + at + camera.depthBytes();
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u)
      {
        *depth++ = static_cast<std::uint16_t>(
            std::lround(1000 * static_cast<double>(scan.rangeUnits) * scan.rangeImage(v, u)));
        for (std::int8_t channel = 2; channel >= 0; --channel)  // MRPT's are blue, green, red
          *color++ = scan.intensityImage.at<std::uint8_t>(
              static_cast<unsigned>(u), static_cast<unsigned>(v), channel);
      }
    ++camera.frames;
  }
  return camera;
}

}  // namespace quadmap
