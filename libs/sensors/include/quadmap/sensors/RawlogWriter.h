#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/sensors/RawlogNames.h"

namespace quadmap
{
/** How a rawlog is written. */
struct RawlogWriterOptions
{
  /** 0 (none) to 9 (smallest); depth images pack well at 1. JPEG files are stored. */
  int compressionLevel = 1;
  int jpegQuality = 95;   //!< 1 to 100; 95 has no visible loss
  bool external = false;  //!< Write images to NAME_Images/ (JPEG and MRPT's .bin) instead
};

/** Writes a rawlog of stock MRPT classes in observation format, and the boxes into its sidecar (see
 * objectsFileOf()). The same content gives the same bytes. The files are one thing: they get their
 * names together in finish(), and two programs cannot write them at the same time. */
class RawlogWriter
{
 public:
  /** \exception std::runtime_error If the files cannot be created.
   *  \exception std::invalid_argument For options out of range. */
  RawlogWriter(const std::string& file, RawlogWriterOptions options);
  ~RawlogWriter();  //!< Removes what was written, unless finish() was called

  /** Writes a scan. \param scan With external images it only keeps the names of their files. */
  void write(mrpt::obs::CObservation3DRangeScan& scan);

  /** Writes a scan whose colour image is this JPEG file, as it is.
   *  \param scan Without colour pixels; it has the names of external files afterwards.
   *  \param jpeg Of 3 x 8 bits, of the size that the scan's cameraParamsIntensity state. */
  void write(mrpt::obs::CObservation3DRangeScan& scan, const std::vector<std::uint8_t>& jpeg);

  /** Writes boxes to the sidecar. */
  void write(const CObservationObjects& boxes);

  /** Writes a pose of the robot (CObservationRobotPose).
   *  \param label kOdometryLabel or kGroundTruthLabel. */
  void writePose(
      mrpt::Clock::time_point time,
      const std::string& label,
      const mrpt::poses::CPose3D& T_parent_robot);

  /** Adds a file that belongs to the recording, beside the rawlog.
   *  \return Where to write it before finish(). */
  std::string add(const std::string& name);

  /** Adds a file of any folder that appears together with the rawlog.
   *  \return Where to write it before finish(); a device or a pipe is written at once.
   *  \exception std::runtime_error If it cannot be written; names the file. */
  std::string addElsewhere(const std::string& path);

  /** Completes all files and gives them their names. When there were no boxes, an older sidecar of
   *  the same name is removed. \exception std::runtime_error For a full disk and the like. */
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quadmap
