// Compiled where OpenNI2 was not found.
#include <stdexcept>

#include "quadmap/cameras/CameraSource.h"

namespace quadmap
{
std::unique_ptr<CameraSource> openOpenNi2(const std::string& what, const CameraOptions& options)
{
  check(options);
  throw std::runtime_error(
      "openni2:" + what +
      ": this program was built without OpenNI2 (package libopenni2-dev; doc/dependencies.md)");
}

}  // namespace quadmap
