#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include "quadmap/simulator/SimulatedDetector.h"

namespace quadmap::simulator
{
/** The mask of an object inside a box. Its border differs from that of the visible pixels by a
 * smooth random shift of about `sigma` [px], as that of a segmenting network. It is nothing when no
 * pixel of the object is in the box. */
std::optional<ObjectMask> noisyMask(
    const RenderedFrame& frame,
    std::size_t object,
    const ImageBox& within,
    double sigma,
    RandomStream& random);

/** Gives each detected object its mask. With DetectorOutput::Masks it is the part inside the box,
 * as of networks that segment boxes. With labels of pixels it is the whole mask. */
void addMasks(
    Detections& found,
    const RenderedFrame& frame,
    const DetectorOptions& options,
    RandomStream& random);

/** Labels the pixels of the masks with "chair" or, for instances, with "chair_2", where 2 is the
 * number of the object among those of its label in the scene. */
void labelPixels(
    const Detections& found,
    const Scene& scene,
    DetectorOutput output,
    mrpt::obs::CObservation3DRangeScan& scan);

}  // namespace quadmap::simulator
