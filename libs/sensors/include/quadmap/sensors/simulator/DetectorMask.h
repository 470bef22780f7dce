#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include "quadmap/sensors/simulator/SimulatedDetector.h"

namespace quadmap::simulator
{
/** The visible pixels of an object inside a box, with a border that wanders about the true one: a
 * smooth random shift of about `sigma` [px], as that of a segmenting network. Nothing when no pixel
 * of it lies in the box. */
std::optional<ObjectMask> noisyMask(
    const RenderedFrame& frame,
    std::size_t object,
    const ImageBox& within,
    double sigma,
    RandomStream& random);

/** Gives each detection of an object its mask: of DetectorOutput::Masks the part in its box, as
 * that of networks which segment in boxes; for labels of pixels all of it. */
void addMasks(
    Detections& found,
    const RenderedFrame& frame,
    const DetectorOptions& options,
    RandomStream& random);

/** Labels the pixels of the masks: with "chair" or, for instances, with "chair_2", where 2 is the
 * object's place among those of its label in the scene. */
void labelPixels(
    const Detections& found,
    const Scene& scene,
    DetectorOutput output,
    mrpt::obs::CObservation3DRangeScan& scan);

}  // namespace quadmap::simulator
