#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/serialization/CArchive.h>

#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** What all objects of an image may have together. */
struct ObjectsBudget
{
  std::uint64_t maskPixels = CObservationObjects::kMostMaskPixels;
  /** Runs of equal pixels in the masks. They take memory and time, where pixels take none. A
   * hundred objects as high as an image of 2160 rows have less than half, at two runs a row. */
  std::uint64_t maskRuns = std::uint64_t{1} << 20;
  /** Bytes of labels and reasons, as labels are compared often. Ours have less than 100 an object.
   */
  std::uint64_t textBytes = 256'000;
};

/** Writes and reads parts of version 0 of CObservationObjects. Reading throws std::runtime_error
 * (or MRPT's CExceptionEOF) for impossible values, and allocates no more memory than possible ones
 * need.
 */
void writeCamera(mrpt::serialization::CArchive& out, const mrpt::img::TCamera& camera);
mrpt::img::TCamera readCamera(mrpt::serialization::CArchive& in);

void writeCoarseDepth(mrpt::serialization::CArchive& out, const CoarseDepth& depth);
CoarseDepth readCoarseDepth(mrpt::serialization::CArchive& in);

/** \param left What the objects of the image may still have; reduced by what this one has. What is
 * written can be read, except for the sum of the masks. */
void writeDetectedObject(
    mrpt::serialization::CArchive& out, const DetectedObject& object, ObjectsBudget& left);
DetectedObject readDetectedObject(mrpt::serialization::CArchive& in, ObjectsBudget& left);

/** Checks a measurement by the rules of ObjectMeasurement.h.
 * \exception std::runtime_error If a part is missing that its kind requires, or a number is not
 * finite. */
void checkMeasurement(const ObjectMeasurement& measurement);

}  // namespace quadmap
