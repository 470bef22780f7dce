// Live frames in, map out: the loop of a program of your own.
//   your-own-loop openni2:live|IN.rawlog OUT.quadmap [DETECTOR]
#include <csignal>
#include <iostream>

#include "quadmap/cameras/CameraSource.h"
#include "quadmap/detection/FrameDetection.h"
#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/odometry/VisualOdometry.h"
#include "quadmap/sensors/RawlogSource.h"

namespace
{
volatile std::sig_atomic_t stopped = 0;
void stop(int) { stopped = 1; }

std::unique_ptr<quadmap::FrameSource> open(const std::string& input)
{
  if (input.rfind("openni2:", 0) == 0) return quadmap::openOpenNi2(input.substr(8), {});
  return std::make_unique<quadmap::RawlogSource>(input, quadmap::RawlogSourceOptions());
}

void run(const std::string& input, const std::string& output, const std::string& model)
{
  const auto source = open(input);
  const auto detector = model.empty() ? nullptr : quadmap::loadDetector(model);
  quadmap::VisualOdometry visual({});  // stands for your robot's odometry where there is none
  quadmap::CQuadricObjectMap map;
  auto frame = source->next();
  const bool hasOdometry = frame && frame->T_odom_robot;  // two odometries would be two frames
  for (int keyframes = 0; frame && !stopped; frame = source->next())
  {
    const auto T_map_robot = hasOdometry ? frame->T_odom_robot : visual.add(*frame->scan);
    const auto boxes = detector ? quadmap::detectObjects(*frame, *detector) : frame->objects;
    if (!T_map_robot || !boxes) continue;  // lost for a moment, or an image without colour
    map.insertObservation(*frame->scan, *T_map_robot);  // measured when its boxes come
    map.insertObservation(*boxes, *T_map_robot);
    if (++keyframes % 20 == 0) map.consolidate();  // merges doubles, decides what is reported
    if (const auto* tv = map.nearest({T_map_robot->x(), T_map_robot->y(), 0}, "tv"))
      std::cout << "the nearest tv is at " << tv->object.center().transpose() << " m\n";
  }
  map.consolidate();
  map.conclude();  // no more images come: lets go of wrong boxes, tells what stays in doubt
  map.saveToFile(output);
  std::cout << map.asString() << "\n";
}
}  // namespace

int main(int argc, char** argv)
try
{
  if (argc < 3) throw std::runtime_error("usage: your-own-loop INPUT OUT.quadmap [DETECTOR]");
  std::signal(SIGINT, stop);
  run(argv[1], argv[2], argc > 3 ? argv[3] : "");
}
catch (const std::exception& e)
{
  std::cerr << "your-own-loop: " << e.what() << "\n";
  return 1;
}
