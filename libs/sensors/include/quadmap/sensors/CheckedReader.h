#pragma once

#include <mrpt/io/CStream.h>
#include <mrpt/serialization/CSerializable.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace quadmap
{
/** Longest side of an image [px]: OpenCV, which rectifies images, counts columns and rows in 16
 * bits.
 */
inline constexpr std::uint64_t kLongestImageSide = 32766;

/** What a stored object may ask for. Files are made by strangers, and the readers of MRPT allocate
 * whatever a file states: one edited count takes gigabytes. */
struct RecordLimits
{
  /** Most pixels of an image, 4096 x 4096. With this size the images that a run holds at a time
   * stay below 1 GB. */
  std::uint64_t imagePixels = std::uint64_t{1} << 24;
  /** Most bytes of one object. */
  std::uint64_t recordBytes = std::uint64_t{1} << 28;
};

/** An object has an embedded image that cannot be decoded, or an embedded depth image of another
 * size than its calibration. The objects behind it can be read. */
struct DamagedImage : std::runtime_error
{
  using std::runtime_error::runtime_error;
  std::string sensor;  //!< The sensor's label, when the object is an observation
};

/** Reads the objects of a stream of MRPT one by one. Before MRPT's own readers see an object, its
 * layout is followed and everything it states about sizes is checked. Memory is taken only for
 * bytes that were in the file.
 *
 * Embedded JPEG images are decoded here, because for some damages MRPT's decoder ends the
 * program. Those of other classes than range scans are left out instead, as quadmap looks at none
 * of them. The 3D points of range scans are left out, too.
 *
 * The objects of other classes that recordings are made of are read by MRPT while memory and
 * nesting are limited. Known ones in them are checked like all others. All other classes are
 * refused, as those that MRPT does not know. */
class CheckedReader
{
 public:
  /** \param from Has to outlive the reader. At the end of a file it has to return 0, and in the
   *  middle of an object it has to throw (see GzInput). */
  explicit CheckedReader(mrpt::io::CStream& from, const RecordLimits& limits = {});

  /** The next object, or null at the end of the stream.
   *  \exception DamagedImage See there.
   *  \exception std::exception If it cannot be read. Reading cannot go on afterwards. */
  mrpt::serialization::CSerializable::Ptr next();

  /** The same where an object only seems to begin. What MRPT reads by itself is refused, as a few
   * bytes can make it take all memory it may have, and a file can be made of nothing but them.
   * Boxes are read: quadmap's own reader checks their counts. */
  mrpt::serialization::CSerializable::Ptr tryNext();

 private:
  mrpt::serialization::CSerializable::Ptr read(bool isTry);

  mrpt::io::CStream& from_;
  RecordLimits limits_;
};

}  // namespace quadmap
