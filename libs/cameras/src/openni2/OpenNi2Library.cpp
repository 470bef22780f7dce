#include <stdexcept>

#include "openni2/OpenNi2Device.h"
#include "quadmap/base/ErrorText.h"

namespace quadmap
{
OpenNi2Library::OpenNi2Library()
{
  if (openni::OpenNI::initialize() == openni::STATUS_OK) return;
  throw std::runtime_error("OpenNI2 has no driver for any camera: " + error());
}

OpenNi2Library::~OpenNi2Library() { openni::OpenNI::shutdown(); }

std::string OpenNi2Library::error()
{
  std::string text = oneLine(openni::OpenNI::getExtendedError());
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.empty() ? "no reason given" : text;
}

OpenNi2Watch::OpenNi2Watch()
{
  openni::OpenNI::addDeviceDisconnectedListener(this);
  openni::OpenNI::addDeviceStateChangedListener(this);
}

OpenNi2Watch::~OpenNi2Watch()
{
  openni::OpenNI::removeDeviceDisconnectedListener(this);
  openni::OpenNI::removeDeviceStateChangedListener(this);
}

void OpenNi2Watch::onDeviceDisconnected(const openni::DeviceInfo* device)
{
  if (device->getUri() == uri_) state_ = RgbdDevice::State::Unplugged;
}

void OpenNi2Watch::onDeviceStateChanged(const openni::DeviceInfo* device, openni::DeviceState state)
{
  if (device->getUri() == uri_ && state == openni::DEVICE_STATE_EOF)
    state_ = RgbdDevice::State::AtEnd;
}

}  // namespace quadmap
