#pragma once

#include <cstddef>
#include <ostream>
#include <string>

#include "FolderImport.h"

namespace quadmap
{
/** Which frames of a rawlog are taken. */
struct RawlogImportOptions
{
  /** What its odometry becomes. True poses stay true poses, and a frame that has one gets no other.
   */
  PosesAs posesAs = PosesAs::Odometry;
  /** File with the poses of the robot (TUM form), instead of its odometry; may be empty. */
  std::string trajectory;
  std::size_t every = 1;        //!< Only every n-th frame of each sensor, >= 1
  bool keepGoing = false;       //!< Leave out what cannot be used instead of throwing
  bool imagesAnywhere = false;  //!< Read external images that lie outside the image folder
};

/** Copies the RGB-D frames of a rawlog, of any number of sensors, with their boxes and their poses
 * into another one, which the caller finishes. Labels of pixels become boxes with masks.
 * \exception std::runtime_error For a record that cannot be used. The message names it. */
FolderImportReport importRawlog(
    const std::string& rawlog,
    const RawlogImportOptions& options,
    RawlogWriter& writer,
    const ProgressCallback& progress);

/** Writes what a rawlog has, sensor by sensor, and what is wrong with it.
 * \param imagesAnywhere See RawlogImportOptions.
 * \return Whether nothing is wrong.
 * \exception std::runtime_error If it cannot be opened. */
bool checkRawlog(
    const std::string& rawlog,
    bool imagesAnywhere,
    std::ostream& out,
    const ProgressCallback& progress);

}  // namespace quadmap
