#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "quadmap/geometry/ImageBox.h"
#include "quadmap/obs/MaskPixels.h"
#include "quadmap/obs/ObjectMeasurement.h"

namespace quadmap
{
/** Which pixels of a box belong to the object. */
struct ObjectMask
{
  unsigned x0 = 0, y0 = 0;         //!< Upper left pixel in the image
  unsigned width = 0, height = 0;  //!< [px]
  MaskPixels pixels;               //!< width * height, row major

  /** False for pixels outside the mask's rectangle. */
  bool contains(unsigned x, unsigned y) const
  {
    return x >= x0 && y >= y0 && x < x0 + width && y < y0 + height &&
           pixels[std::size_t{y - y0} * width + (x - x0)];
  }
};

/** One box of a detector, and the measurement that perception made of it. */
struct DetectedObject
{
  std::string label;  //!< As the detector spelled it
  double score = 1;   //!< In [0, 1]
  ImageBox box;
  std::optional<ObjectMask> mask;
  std::optional<std::uint32_t> instanceId;  //!< Set when the input already knows which object it is
  ObjectMeasurement measurement;
};

}  // namespace quadmap
