#pragma once

#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDF.h>

#include <optional>
#include <string>

#include "quadmap/base/GzipInput.h"
#include "quadmap/sensors/CheckedReader.h"

namespace quadmap
{
/** Reads the keyframes of a .simplemap one by one. mrpt::maps::CSimpleMap would hold all images in
 * memory at once. */
class SimpleMapReader
{
 public:
  struct Keyframe
  {
    mrpt::poses::CPose3DPDF::Ptr pose;  //!< T_map_robot
    mrpt::obs::CSensoryFrame::Ptr observations;
  };

  /** \exception std::runtime_error If the file cannot be read or is no simple map. */
  explicit SimpleMapReader(const std::string& path);

  std::size_t size() const { return size_; }  //!< Number of keyframes in the file

  /** The next keyframe, or nothing after the last one.
   *  \exception std::runtime_error If the file is damaged or has an object of an unknown class. The
   *  message names file and keyframe, and the class where it could be read. */
  std::optional<Keyframe> next();

 private:
  /** The next object; null at the end. \exception std::runtime_error Begins with `place`. */
  mrpt::serialization::CSerializable::Ptr object(const std::string& place);
  void requireEnd();  //!< \exception std::runtime_error If the end is cut, damaged or not the end

  std::string path_;
  GzInput file_;
  CheckedReader records_;
  std::size_t size_ = 0, read_ = 0;
};

}  // namespace quadmap
