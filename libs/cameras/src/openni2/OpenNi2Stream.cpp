#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <set>
#include <stdexcept>
#include <utility>

#include "openni2/OpenNi2Device.h"

namespace quadmap
{
namespace
{
const char* nameOf(openni::PixelFormat format)
{
  switch (format)
  {
    case openni::PIXEL_FORMAT_GRAY8:
    case openni::PIXEL_FORMAT_GRAY16:
      return "grey";
    case openni::PIXEL_FORMAT_JPEG:
      return "JPEG";
    default:
      return "another format";
  }
}

/** Whether two pixels have their own brightness and one colour together. */
bool isYuv(openni::PixelFormat format)
{
  return format == openni::PIXEL_FORMAT_YUV422 || format == openni::PIXEL_FORMAT_YUYV;
}

/** The colours of an image in OpenCV's order. OpenNI2's YUV 4:2:2 begins with U. */
cv::Mat blueGreenRed(const cv::Mat& pixels, openni::PixelFormat format)
{
  cv::Mat bgr;
  if (format == openni::PIXEL_FORMAT_YUV422)
    cv::cvtColor(pixels, bgr, cv::COLOR_YUV2BGR_UYVY);
  else if (format == openni::PIXEL_FORMAT_YUYV)
    cv::cvtColor(pixels, bgr, cv::COLOR_YUV2BGR_YUYV);
  else
    cv::cvtColor(pixels, bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

std::string sizeOf(const openni::VideoMode& mode)
{
  return std::to_string(mode.getResolutionX()) + "x" + std::to_string(mode.getResolutionY());
}
}  // namespace

OpenNi2Stream::OpenNi2Stream(openni::Device& device, openni::SensorType sensor) : sensor_(sensor)
{
  if (device.getSensorInfo(sensor) == nullptr)
    throw std::runtime_error(std::string("has no ") + name() + " images");
  if (stream_.create(device, sensor) != openni::STATUS_OK)
    throw std::runtime_error(
        std::string("its ") + name() + " images cannot be read: " + OpenNi2Library::error());
}

bool OpenNi2Stream::isUnderstood(openni::PixelFormat format) const
{
  if (!isDepth()) return format == openni::PIXEL_FORMAT_RGB888 || isYuv(format);
  return format == openni::PIXEL_FORMAT_DEPTH_1_MM || format == openni::PIXEL_FORMAT_DEPTH_100_UM;
}

std::string OpenNi2Stream::sizes() const
{
  const auto& modes = stream_.getSensorInfo().getSupportedVideoModes();
  std::set<std::string> sizes;
  for (int i = 0; i < modes.getSize(); ++i)
    if (isUnderstood(modes[i].getPixelFormat())) sizes.insert(sizeOf(modes[i]));
  std::string text;
  for (const auto& size : sizes) text += (text.empty() ? "" : ", ") + size;
  return text.empty() ? "none that are understood" : text;
}

void OpenNi2Stream::choose(const CameraOptions& options)
{
  const auto& modes = stream_.getSensorInfo().getSupportedVideoModes();
  const openni::VideoMode* best = nullptr;
  // Full colours before those of pairs of pixels, then the nearest rate.
  const auto distance = [&](const openni::VideoMode& mode)
  {
    return std::make_pair(
        isYuv(mode.getPixelFormat()), std::abs(mode.getFps() - static_cast<int>(options.fps)));
  };
  for (int i = 0; i < modes.getSize(); ++i)
    if (isUnderstood(modes[i].getPixelFormat()) &&
        modes[i].getResolutionX() == static_cast<int>(options.width) &&
        modes[i].getResolutionY() == static_cast<int>(options.height) &&
        (!best || distance(modes[i]) < distance(*best)))
      best = &modes[i];
  if (!best)
    throw std::runtime_error(
        std::string("has no ") + name() + " images of " + std::to_string(options.width) + "x" +
        std::to_string(options.height) + "; there are: " + sizes());
  if (stream_.setVideoMode(*best) != openni::STATUS_OK)
    throw std::runtime_error(
        std::string("its ") + name() + " images of " + sizeOf(*best) +
        " cannot be had: " + OpenNi2Library::error());
  stream_.setMirroringEnabled(false);
}

void OpenNi2Stream::start()
{
  const openni::VideoMode current = mode();
  if (!isUnderstood(current.getPixelFormat()))
    throw std::runtime_error(
        std::string("its ") + name() + " images are " + nameOf(current.getPixelFormat()) +
        ", which is not understood");
  isMirrored_ = stream_.getMirroringEnabled();  // some cameras and all recordings cannot change it
  if (stream_.start() != openni::STATUS_OK)
    throw std::runtime_error(
        std::string("its ") + name() + " images do not start: " + OpenNi2Library::error());
}

/** The field of view ends at the outer edges of the outermost pixels, whose centres are half a
 * pixel inside: fx = (width / 2) / tan(hfov / 2), cx = (width - 1) / 2, and so for y. */
mrpt::img::TCamera OpenNi2Stream::calibration(const CameraOptions& options) const
{
  mrpt::img::TCamera camera;
  camera.ncols = static_cast<std::uint32_t>(mode().getResolutionX());
  camera.nrows = static_cast<std::uint32_t>(mode().getResolutionY());
  if (options.intrinsics)
  {
    const auto& [fx, fy, cx, cy] = *options.intrinsics;
    camera.setIntrinsicParamsFromValues(fx, fy, cx, cy);
    return camera;
  }
  if (options.calibration) return scaledTo(*options.calibration, camera.ncols, camera.nrows);
  const double horizontal = static_cast<double>(stream_.getHorizontalFieldOfView()),
               vertical = static_cast<double>(stream_.getVerticalFieldOfView());
  if (!(horizontal > 0 && horizontal < M_PI && vertical > 0 && vertical < M_PI))
    throw std::runtime_error(
        std::string("does not state the field of view of its ") + name() +
        " images; give --intrinsics FX,FY,CX,CY");
  camera.setIntrinsicParamsFromValues(
      0.5 * camera.ncols / std::tan(horizontal / 2), 0.5 * camera.nrows / std::tan(vertical / 2),
      0.5 * (camera.ncols - 1), 0.5 * (camera.nrows - 1));
  return camera;
}

DeviceImage OpenNi2Stream::read()
{
  openni::VideoFrameRef frame;
  if (stream_.readFrame(&frame) != openni::STATUS_OK || !frame.isValid())
    throw std::runtime_error(
        std::string("a ") + name() + " image cannot be read: " + OpenNi2Library::error());
  const openni::VideoMode expected = mode();
  const auto format = expected.getPixelFormat();
  const bool hasTwoBytes = isDepth() || isYuv(format);
  const int bytesPerPixel = hasTwoBytes ? 2 : 3, stride = frame.getStrideInBytes();
  if (frame.getWidth() != expected.getResolutionX() ||
      frame.getHeight() != expected.getResolutionY() || stride < frame.getWidth() * bytesPerPixel ||
      frame.getDataSize() < frame.getHeight() * stride)
    throw std::runtime_error(std::string("a ") + name() + " image is not " + sizeOf(expected));
  const int type = isDepth() ? CV_16UC1 : hasTwoBytes ? CV_8UC2 : CV_8UC3;
  const cv::Mat pixels(
      frame.getHeight(), frame.getWidth(), type, const_cast<void*>(frame.getData()),
      static_cast<std::size_t>(stride));
  DeviceImage image;
  image.kind = isDepth() ? DeviceImage::Kind::Depth : DeviceImage::Kind::Color;
  image.time = 1e-6 * static_cast<double>(frame.getTimestamp());
  image.number = frame.getFrameIndex();
  if (isDepth())
    pixels.copyTo(image.pixels);
  else
    image.pixels = blueGreenRed(pixels, format);
  if (isMirrored_) cv::flip(image.pixels, image.pixels, 1);
  return image;
}

}  // namespace quadmap
