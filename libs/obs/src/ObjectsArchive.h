#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/serialization/CArchive.h>

#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** Parts of version 0 of CObservationObjects in the stream. Reading throws std::runtime_error (or
 * MRPT's CExceptionEOF) for values that cannot be, and allocates no more than they allow. */
void writeCamera(mrpt::serialization::CArchive& out, const mrpt::img::TCamera& camera);
mrpt::img::TCamera readCamera(mrpt::serialization::CArchive& in);

void writeCoarseDepth(mrpt::serialization::CArchive& out, const CoarseDepth& depth);
CoarseDepth readCoarseDepth(mrpt::serialization::CArchive& in);

void writeDetectedObject(mrpt::serialization::CArchive& out, const DetectedObject& object);
DetectedObject readDetectedObject(mrpt::serialization::CArchive& in);

/** \exception std::runtime_error If a measurement breaks the rules of ObjectMeasurement.h: parts
 * that its kind promises are missing, or a number is not finite. */
void checkMeasurement(const ObjectMeasurement& measurement);

}  // namespace quadmap
