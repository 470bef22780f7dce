#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include "quadmap/perception/FramePerception.h"
#include "quadmap/surfaces/RoomPlanes.h"

namespace quadmap
{
/** Measures the boxes of one frame with the surfaces of the room in mind; the room stays as it is.
 * \param boxes Of the same image as `scan`; their measurements are filled in.
 * \param T_map_sensor Pose of the frame's sensor in a z-up map.
 * \param room Surfaces known from earlier frames.
 * \return The surfaces that the frame shows, for RoomPlanes::add().
 * \exception std::runtime_error If the scan has no depth image or no usable calibration. */
FrameSurfaces measureInRoom(
    const FramePerception& perception,
    const mrpt::obs::CObservation3DRangeScan& scan,
    CObservationObjects& boxes,
    const mrpt::poses::CPose3D& T_map_sensor,
    const RoomPlanes& room);

/** The same, and the room remembers the surfaces that the frame shows. */
FrameSurfaces measureAndRemember(
    const FramePerception& perception,
    const mrpt::obs::CObservation3DRangeScan& scan,
    CObservationObjects& boxes,
    const mrpt::poses::CPose3D& T_map_sensor,
    RoomPlanes& room);

/** Measures frame after frame of one room, and remembers the surfaces of the room. */
class RoomPerception
{
 public:
  RoomPerception(const PerceptionOptions& options, const LabelTable& labels) :
      perception_(options, labels)
  {
  }

  /** Measures the boxes of the next frame, as measureInRoom() does. */
  FrameSurfaces measure(
      const mrpt::obs::CObservation3DRangeScan& scan,
      CObservationObjects& boxes,
      const mrpt::poses::CPose3D& T_map_sensor)
  {
    return measureAndRemember(perception_, scan, boxes, T_map_sensor, room_);
  }

  /** What measure() would judge the edges of the boxes of the next frame by; the room stays as it
   * is. */
  std::vector<std::optional<BoxEvidence>> edgeEvidence(
      const mrpt::obs::CObservation3DRangeScan& scan,
      const CObservationObjects& boxes,
      const mrpt::poses::CPose3D& T_map_sensor) const;

  const RoomPlanes& room() const { return room_; }  //!< Surfaces known so far

 private:
  FramePerception perception_;
  RoomPlanes room_;
};

}  // namespace quadmap
