#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>

#include <cstdint>
#include <vector>

#include "quadmap/geometry/PinholeCamera.h"
#include "quadmap/obs/DetectedObject.h"

namespace quadmap
{
/** Depth of the frame on a coarse grid over the image, for tests of visibility without the image.
 * Each cell has the median of its depths [m], or 0 where nothing was measured. Row major. */
struct CoarseDepth
{
  unsigned columns = 0, rows = 0;
  std::vector<float> depth;

  bool empty() const { return depth.empty(); }
};

/** The objects that a detector saw in one image, with the measurements that perception made of
 * them. It belongs to the range scan with the same sensorLabel and time stamp. */
class CObservationObjects : public mrpt::obs::CObservation
{
  DEFINE_SERIALIZABLE(CObservationObjects, quadmap)

 public:
  /** Most objects of an image. Detectors end at 100 or 300; association takes cubic time. */
  static constexpr std::uint32_t kMostObjects = 300;
  /** Most pixels of all masks of an image, 64 MB. */
  static constexpr std::uint64_t kMostMaskPixels = std::uint64_t{1} << 26;

  mrpt::img::TCamera cameraParams;  //!< Calibration of the image that the boxes are in
  mrpt::poses::CPose3D sensorPose;  //!< T_robot_sensor; sensor frame x forward, y left, z up
  std::vector<DetectedObject> objects;
  CoarseDepth coarseDepth;  //!< Empty when no depth image was used

  void getSensorPose(mrpt::poses::CPose3D& out) const override { out = sensorPose; }
  void setSensorPose(const mrpt::poses::CPose3D& p) override { sensorPose = p; }
  void getDescriptionAsText(std::ostream& o) const override;

  bool exportTxtSupported() const override { return true; }
  std::string exportTxtHeader() const override;
  std::string exportTxtDataRow() const override;
};

/** The pinhole part of an MRPT calibration. */
PinholeCamera pinholeFrom(const mrpt::img::TCamera& camera);

/** Registers the classes of this library with MRPT's factory. Calling it also keeps the linker from
 * dropping the library in programs that need it through serialization only. */
void registerObsClasses();

}  // namespace quadmap
