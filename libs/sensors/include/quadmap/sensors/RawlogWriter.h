#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <memory>
#include <string>

#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/sensors/RawlogNames.h"

namespace quadmap
{
/** How a rawlog is written. */
struct RawlogWriterOptions
{
  int gzLevel = 1;        //!< 0 (store) ... 9 (smallest); 1: depth images pack well already
  int jpegQuality = 95;   //!< 1 ... 100; 95: no visible loss
  bool external = false;  //!< Images into NAME_Images/ (JPEG and MRPT's .bin), not into the rawlog
};

/** Writes a rawlog of stock MRPT classes in observation format, and the boxes into its sidecar
 * (objectsFileOf). The bytes depend on what is written only. Nothing appears under a final name
 * before finish(). */
class RawlogWriter
{
 public:
  /** \exception std::runtime_error If the files cannot be created.
   *  \exception std::invalid_argument For options out of range. */
  RawlogWriter(std::string file, RawlogWriterOptions options);
  ~RawlogWriter();  //!< Without finish() everything written is removed

  /** \param scan With external images it keeps references to the files only. */
  void write(mrpt::obs::CObservation3DRangeScan& scan);

  /** Goes to the sidecar. */
  void write(const CObservationObjects& boxes);

  /** A pose of the robot (CObservationRobotPose). \param label kOdometryLabel or kGroundTruthLabel
   */
  void writePose(
      mrpt::Clock::time_point time,
      const std::string& label,
      const mrpt::poses::CPose3D& T_parent_robot);

  /** Completes all files and gives them their names. An older sidecar of the same name goes when
   *  there were no boxes. \exception std::runtime_error For a full disk and the like. */
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quadmap
