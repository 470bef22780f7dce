// make-camera IN.rawlog FILE FRAMES FPS: writes a file for the driver of the tests, which then
// shows the first frames of the rawlog as if they came from a camera.
#include <cstdlib>
#include <iostream>

#include "CameraOfRawlog.h"

int main(int argc, char** argv)
try
{
  if (argc != 5) throw std::invalid_argument("make-camera IN.rawlog FILE FRAMES FPS");
  auto camera = quadmap::cameraOf(argv[1], std::atoi(argv[3]));
  camera.fps = std::atof(argv[4]);
  camera.save(argv[2]);
}
catch (const std::exception& e)
{
  std::cerr << e.what() << "\n";
  return 1;
}
