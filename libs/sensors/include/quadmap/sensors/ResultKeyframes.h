#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/obs/BoxObjects.h"
#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/sensors/SimpleMapReader.h"

namespace quadmap
{
/** An image of a keyframe, with what a run of quadmap-slam made of it. */
struct KeyframeScan
{
  mrpt::obs::CObservation3DRangeScan::Ptr scan;  //!< Its images are in memory
  mrpt::poses::CPose3D T_map_robot;
  CObservationObjects::Ptr boxes;  //!< Null when no detector looked, or boxes are not read
  /** The id of the object that each box was taken for, if any; empty when the report does not know
   * the image. */
  std::vector<std::optional<unsigned>> objectOfBox;
};

/** Reads the keyframes of a folder of quadmap-slam one by one: map.simplemap and, for the boxes,
 * objects.simplemap and report.json. */
class ResultKeyframes
{
 public:
  enum class Boxes
  {
    Read,
    Ignore
  };

  /** \exception std::runtime_error For a file that is missing or cannot be read, or files of
   * different runs; names it. */
  ResultKeyframes(const std::string& folder, Boxes boxes);

  std::size_t size() const { return scans_.size(); }  //!< Number of keyframes
  std::size_t keyframesRead() const { return read_; }
  const std::string& path() const { return path_; }  //!< Of map.simplemap, for messages

  /** The images of the next keyframe, or nothing after the last one.
   *  \exception std::runtime_error For a damaged file, and for images that are not in it. */
  std::optional<std::vector<KeyframeScan>> next();

 private:
  std::string path_;
  SimpleMapReader scans_;
  std::optional<SimpleMapReader> boxes_;
  std::optional<BoxObjects> objectsOfBoxes_;
  std::size_t read_ = 0;
};

}  // namespace quadmap
