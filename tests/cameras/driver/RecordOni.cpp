// record-oni FILE N: records N pairs of images of the first camera, as any program of OpenNI2 does.
#include <OpenNI.h>

#include <cstdlib>
#include <iostream>

namespace
{
void require(openni::Status status)
{
  if (status == openni::STATUS_OK) return;
  std::cerr << openni::OpenNI::getExtendedError() << "\n";
  std::exit(1);
}

void record(const char* file, int frames)
{
  openni::Device device;
  openni::VideoStream depth, color;
  openni::Recorder recorder;
  openni::VideoFrameRef frame;
  require(device.open(openni::ANY_DEVICE));
  require(depth.create(device, openni::SENSOR_DEPTH));
  require(color.create(device, openni::SENSOR_COLOR));
  require(recorder.create(file));
  require(recorder.attach(depth));
  require(recorder.attach(color));
  require(recorder.start());
  require(device.setDepthColorSyncEnabled(true));
  require(depth.start());
  require(color.start());
  for (int i = 0; i < frames; ++i)
  {
    require(depth.readFrame(&frame));
    require(color.readFrame(&frame));
  }
  recorder.stop();
  frame.release();
  color.stop();
  depth.stop();
  recorder.destroy();
  color.destroy();
  depth.destroy();
  device.close();
}
}  // namespace

int main(int, char** argv)
{
  require(openni::OpenNI::initialize());
  record(argv[1], std::atoi(argv[2]));
  openni::OpenNI::shutdown();
}
