#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <optional>
#include <string>
#include <vector>

#include "quadmap/geometry/Ellipsoid.h"
#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** An object of the map, as seen from a frame. */
struct ObjectInFrame
{
  std::string id, label;
  Ellipsoid object_sensor;  //!< In the sensor frame (x forward)
};

/** What a picture of one frame shows. */
struct FramePictureContent
{
  const mrpt::obs::CObservation3DRangeScan* scan = nullptr;  //!< Its colour image; else its depth
  const mrpt::img::CImage* image = nullptr;    //!< Shown instead of the scan's, when there is one
  const CObservationObjects* boxes = nullptr;  //!< Null when no detector looked
  /** The object that each box was taken for, its id and what else is to be said of it; "" for
   * none. Empty before there is a map. */
  std::vector<std::string> objectOfBox;
  std::vector<ObjectInFrame> objects;
};

/** Draws what a detector and the perception saw in a frame, over its image, which is magnified to
 * some 1200 pixels.
 *
 * A box that perception has not looked at has the colour of its label. Else its usable edges are
 * green and the unusable ones grey, with the reason beside them. Its text has the label and score,
 * the object it was taken for, the model that was chosen, and why. The measured cuboid is white;
 * its side on the support is filled with yellow. Objects of the map are drawn in the colour of
 * their label, made lighter where it is dark, as the outlines of ellipsoid and cuboid, with their
 * id. Masks are tinted. */
mrpt::img::CImage drawFrame(const FramePictureContent& content);

}  // namespace quadmap
