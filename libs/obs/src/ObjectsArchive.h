#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/serialization/CArchive.h>

#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** Writes and reads parts of version 0 of CObservationObjects. Reading throws std::runtime_error
 * (or MRPT's CExceptionEOF) for impossible values, and allocates no more memory than possible ones
 * need.
 */
void writeCamera(mrpt::serialization::CArchive& out, const mrpt::img::TCamera& camera);
mrpt::img::TCamera readCamera(mrpt::serialization::CArchive& in);

void writeCoarseDepth(mrpt::serialization::CArchive& out, const CoarseDepth& depth);
CoarseDepth readCoarseDepth(mrpt::serialization::CArchive& in);

void writeDetectedObject(mrpt::serialization::CArchive& out, const DetectedObject& object);
/** \param maskPixelsLeft How many pixels the masks of the image may still have; reduced by those of
 * this object. */
DetectedObject readDetectedObject(mrpt::serialization::CArchive& in, std::uint64_t& maskPixelsLeft);

/** Checks a measurement by the rules of ObjectMeasurement.h.
 * \exception std::runtime_error If a part is missing that its kind requires, or a number is not
 * finite. */
void checkMeasurement(const ObjectMeasurement& measurement);

}  // namespace quadmap
