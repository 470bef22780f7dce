#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "quadmap/folders/FrameFolder.h"
#include "quadmap/sensors/RawlogWriter.h"

namespace quadmap
{
/** What the poses of a recording become in the rawlog. */
enum class PosesAs
{
  Odometry,
  GroundTruth,
  None
};

struct FolderImportOptions
{
  PosesAs posesAs = PosesAs::Odometry;
  std::size_t every = 1;   //!< Only every n-th frame, >= 1
  bool keepGoing = false;  //!< Leave out what cannot be used instead of throwing
};

struct FolderImportReport
{
  std::size_t frames = 0, poses = 0, boxes = 0;  //!< Numbers of what was written
  std::size_t withoutDetections = 0;             //!< Number of frames that the files of boxes lack
  std::string firstWithoutDetections;            //!< Where the boxes of the first of them should be
  std::size_t crowdedImages = 0;     //!< Number of images with more boxes than one may have
  std::string firstCrowded;          //!< Where the boxes of the first of them are
  bool hasOdometry = false;          //!< A rawlog has some, be it at the times of its images or not
  std::size_t copiedImages = 0;      //!< Number of colour images that were not encoded anew
  std::vector<std::string> dropped;  //!< One text for each that keepGoing left out
  std::vector<std::string> notes;    //!< What may be off in what was written
};

/** Called with the share that is done, in [0, 1]. */
using ProgressCallback = std::function<void(double)>;

/** Writes a recording into a rawlog, which the caller finishes.
 * \exception std::runtime_error For a frame that cannot be used. The message names its file. */
FolderImportReport importFolder(
    const FrameFolder& folder,
    const FolderImportOptions& options,
    RawlogWriter& writer,
    const ProgressCallback& progress);

}  // namespace quadmap
