#pragma once

namespace quadmap
{
/** Axis-aligned box in an image [px]. Pixel centres are at integers, x points right and y down. */
struct ImageBox
{
  double x1 = 0, y1 = 0, x2 = 0, y2 = 0;

  double width() const { return x2 - x1; }
  double height() const { return y2 - y1; }
  double area() const { return isValid() ? width() * height() : 0.0; }  //!< [px^2]
  double centerX() const { return 0.5 * (x1 + x2); }
  double centerY() const { return 0.5 * (y1 + y2); }

  /** Whether all numbers are finite, and width and height are positive. */
  bool isValid() const;

  /** The part inside the image [0, width-1] x [0, height-1]; it is not valid when there is none. */
  ImageBox clipped(unsigned imageWidth, unsigned imageHeight) const;
};

/** Intersection over union of two boxes, in [0, 1]; 0 when one of them is not valid. */
double imageBoxIoU(const ImageBox& a, const ImageBox& b);

}  // namespace quadmap
