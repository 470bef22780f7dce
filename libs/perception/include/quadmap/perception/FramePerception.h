#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <Eigen/Dense>
#include <memory>
#include <optional>

#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/obs/LabelTable.h"
#include "quadmap/perception/HiddenPart.h"
#include "quadmap/perception/PerceptionOptions.h"
#include "quadmap/surfaces/SurfacePatch.h"

namespace quadmap
{
/** Turns the detector boxes of one RGB-D frame into measurements (doc/mathematics.md).
 *
 * Holds no state between frames: the same frame gives the same measurements. */
class FramePerception
{
 public:
  FramePerception(const PerceptionOptions& options, const LabelTable& labels);
  ~FramePerception();

  /** Fills `measurement` of every box, and coarseDepth.
   * \param scan Depth image with calibration; need not be unprojected.
   * \param boxes Of the same image.
   * \param up_sensor Unit vector that points up in the sensor frame, e.g. from the robot's pose in
   * a z-up world; when absent, up comes from the planes of the scene.
   * \param known_sensor Surfaces of the room according to other frames (see RoomPlanes); what this
   * frame shows of them goes before it.
   * \return The surfaces of this frame and what it looks through, sensor frame.
   * \exception std::runtime_error If the scan has no depth image or no usable calibration. */
  FrameSurfaces measure(
      const mrpt::obs::CObservation3DRangeScan& scan,
      CObservationObjects& boxes,
      const std::optional<Eigen::Vector3d>& up_sensor,
      const std::vector<SurfacePatch>& known_sensor = {}) const;

  /** What measure() judges the edges of each box by, to fit the weights of (9.2) to; nothing for a
   * box that shows no part of the image. Parameters and exceptions as above. */
  std::vector<std::optional<BoxEvidence>> edgeEvidence(
      const mrpt::obs::CObservation3DRangeScan& scan,
      const CObservationObjects& boxes,
      const std::optional<Eigen::Vector3d>& up_sensor,
      const std::vector<SurfacePatch>& known_sensor = {}) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quadmap
