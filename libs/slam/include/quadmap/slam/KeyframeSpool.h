#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "quadmap/obs/CObservationObjects.h"
#include "quadmap/obs/OutputFile.h"

namespace quadmap
{
/** The images and boxes of all keyframes in a temporary file, so that memory does not grow with
 * their number. The file goes with the object.
 *
 * Each keyframe is a CSensoryFrame with the range scan and one with the boxes, each a gzip member
 * of its own: a .simplemap file takes them over as they are. */
class KeyframeSpool
{
 public:
  using Bytes = std::vector<std::uint8_t>;

  /** \param directory Where the file lives. \exception std::runtime_error If it is not writable. */
  explicit KeyframeSpool(const std::string& directory);
  ~KeyframeSpool();
  KeyframeSpool(const KeyframeSpool&) = delete;
  KeyframeSpool& operator=(const KeyframeSpool&) = delete;

  /** Appends a keyframe. Images kept in external files are embedded; points are left out, because
   *  any reader can compute them.
   *  \param objects May be null: nobody looked for objects.
   *  \exception std::runtime_error On a full disk. */
  void append(const mrpt::obs::CObservation3DRangeScan& scan, const CObservationObjects* objects);

  std::size_t size() const { return keyframes_.size(); }

  Bytes scanMember(std::size_t keyframe) const;     //!< gzip of a CSensoryFrame with the scan
  Bytes objectsMember(std::size_t keyframe) const;  //!< gzip of a CSensoryFrame with the boxes

  /** The boxes of a keyframe; null when nobody looked. */
  CObservationObjects::Ptr objects(std::size_t keyframe) const;

 private:
  struct Block
  {
    std::uint64_t offset = 0, size = 0;  //!< [bytes]
  };
  struct KeyframeBlocks
  {
    Block scan, objects;
  };
  Block write(const Bytes& bytes);
  Bytes read(const Block& block) const;

  OutputFile file_;  //!< Never committed: removed in the end
  int descriptor_ = -1;
  std::uint64_t end_ = 0;
  std::vector<KeyframeBlocks> keyframes_;
};

}  // namespace quadmap
