#pragma once

#include <string>

#include "quadmap/cameras/CameraOptions.h"
#include "quadmap/sensors/RawlogWriter.h"

namespace quadmap
{
/** What is imported from a camera, and how it is written. */
struct CameraImportRequest
{
  std::string source;  //!< See openOpenNi2()
  std::string output;  //!< The rawlog
  CameraOptions camera;
  RawlogWriterOptions writing;
  std::size_t every = 1;  //!< Only every n-th frame, >= 1
};

/** Writes the frames of a camera, or of a recording of one, into a rawlog until it ends, fails, or
 * Ctrl-C ends a camera. Tells on the terminal how that goes.
 * \return The exit status: 1 when the camera failed. The rawlog then has the frames before.
 * \exception std::runtime_error If there was no frame, or the rawlog cannot be written. */
int importCamera(const CameraImportRequest& request);

}  // namespace quadmap
