#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cstdint>
#include <string>
#include <vector>

#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** Where external images may lie, and how large they may be. */
struct ImageRules
{
  std::string folder;            //!< Of the external images
  std::string rawlogFolder;      //!< Of the rawlog; a link of the image folder may not lead out
  bool imagesAnywhere = false;   //!< They may lie elsewhere
  std::string imagesHint;        //!< How a user allows that, for messages; empty: not at all
  std::uint64_t mostPixels = 0;  //!< Of an image
};

/** Loads the external images of a scan, checks the scan, and brings it into the form that the rest
 * of the program reads: a range image of depths, with a calibration of its size.
 * \exception std::runtime_error If the scan is wrong. The message names neither file nor record. */
void prepareScan(mrpt::obs::CObservation3DRangeScan& scan, const ImageRules& rules);

/** Removes the boxes that cannot be used (see whyUnusable()). \return One text for each of them. */
std::vector<std::string> removeUnusableBoxes(CObservationObjects& boxes);

}  // namespace quadmap
