#pragma once

#include "quadmap/detection/Detector.h"
#include "quadmap/sensors/RgbdFrame.h"

namespace quadmap
{
/** The colour image of a frame as it was recorded, in the size of the depth image. The frame has
 * one. */
mrpt::img::CImage recordedImage(const RgbdFrame& frame);

/** Looks for the objects of a frame in its colour image, as it was recorded, and brings them into
 * the pixels of its depth image.
 * \return Boxes with calibration, time and label of the frame; null without a colour image.
 * \exception std::runtime_error As in Detector::detect(). */
CObservationObjects::Ptr detectObjects(const RgbdFrame& frame, Detector& detector);

}  // namespace quadmap
