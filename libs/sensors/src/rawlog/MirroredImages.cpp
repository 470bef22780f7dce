#include "rawlog/MirroredImages.h"

#include <algorithm>
#include <opencv2/core.hpp>

namespace quadmap
{
namespace
{
using mrpt::obs::TPixelLabelInfo;
using mrpt::obs::TPixelLabelInfoBase;

template <typename Matrix>
void turn(Matrix& matrix)
{
  matrix = matrix.asEigen().colwise().reverse().eval();
}

void turn(mrpt::img::CImage& image)
{
  cv::Mat turned;
  cv::flip(image.asCvMatRef(), turned, 0);
  image = mrpt::img::CImage(turned, mrpt::img::SHALLOW_COPY);
}

template <unsigned int Bytes>
void turnLabels(TPixelLabelInfoBase& labels)
{
  auto* info = dynamic_cast<TPixelLabelInfo<Bytes>*>(&labels);
  if (info) turn(info->pixelLabels);
}

void turn(mrpt::img::TCamera& camera)
{
  camera.setIntrinsicParamsFromValues(
      camera.fx(), -camera.fy(), camera.cx(), camera.nrows - 1.0 - camera.cy());
}

void turn(DetectedObject& object, unsigned rows)
{
  const double last = rows - 1.0;
  object.box = {object.box.x1, last - object.box.y2, object.box.x2, last - object.box.y1};
  if (!object.mask) return;
  ObjectMask& mask = *object.mask;
  mask.y0 = rows - std::min(rows, mask.y0 + mask.height);
  auto pixels = mask.pixels.expanded();
  for (unsigned row = 0; row < mask.height / 2; ++row)
    std::swap_ranges(
        pixels.begin() + row * mask.width, pixels.begin() + (row + 1) * mask.width,
        pixels.begin() + (mask.height - 1 - row) * mask.width);
  mask.pixels = pixels;
}

void turnDepth(mrpt::obs::CObservation3DRangeScan& scan)
{
  turn(scan.rangeImage);
  for (auto& layer : scan.rangeImageOtherLayers) turn(layer.second);
  if (scan.hasConfidenceImage) turn(scan.confidenceImage);
  if (scan.pixelLabels)
  {
    turnLabels<1>(*scan.pixelLabels);
    turnLabels<2>(*scan.pixelLabels);
    turnLabels<3>(*scan.pixelLabels);
    turnLabels<4>(*scan.pixelLabels);
    turnLabels<8>(*scan.pixelLabels);
  }
  turn(scan.cameraParams);
}

}  // namespace

void makeFyPositive(RgbdFrame& frame)
{
  auto& scan = *frame.scan;
  frame.isTurned = scan.cameraParams.fy() < 0 || scan.cameraParamsIntensity.fy() < 0;
  if (scan.cameraParams.fy() < 0) turnDepth(scan);
  if (scan.cameraParamsIntensity.fy() < 0)
  {
    if (scan.hasIntensityImage) turn(scan.intensityImage);
    turn(scan.cameraParamsIntensity);
  }
  if (frame.objects && frame.objects->cameraParams.fy() < 0) turnUpsideDown(*frame.objects);
}

void turnUpsideDown(CObservationObjects& boxes)
{
  for (auto& object : boxes.objects) turn(object, boxes.cameraParams.nrows);
  turn(boxes.cameraParams);
}

}  // namespace quadmap
