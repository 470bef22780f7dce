#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/obs/CObservationObjects.h"

namespace quadmap
{
/** The images and boxes of all keyframes, in a temporary file, so that memory does not grow with
 * their number. The file has no name and vanishes when the program ends, however it ends.
 *
 * Each observation is a gzip member of its own, a large one several, which are copied to a
 * .simplemap file unchanged. */
class KeyframeSpool
{
 public:
  using Bytes = std::vector<std::uint8_t>;

  /** \param directory Directory of the file. \exception std::runtime_error If it is not writable.
   */
  explicit KeyframeSpool(const std::string& directory);
  ~KeyframeSpool();
  KeyframeSpool(const KeyframeSpool&) = delete;
  KeyframeSpool& operator=(const KeyframeSpool&) = delete;

  /** Appends a keyframe. Images in external files are embedded. Points are left out, because any
   *  reader can compute them.
   *  \param objects Null when no detector looked at the frame.
   *  \exception std::runtime_error On a full disk. */
  void append(const mrpt::obs::CObservation3DRangeScan& scan, const CObservationObjects* objects);

  std::size_t size() const { return keyframes_.size(); }

  Bytes scanMembers(std::size_t keyframe) const;  //!< gzip of the CObservation3DRangeScan
  /** gzip of the CObservationObjects, or nothing when no detector looked. */
  std::optional<Bytes> objectsMember(std::size_t keyframe) const;

  /** The boxes of a keyframe, or null when no detector looked. */
  CObservationObjects::Ptr objects(std::size_t keyframe) const;

 private:
  struct Block
  {
    std::uint64_t offset = 0, size = 0;  //!< [bytes]
  };
  struct KeyframeBlocks
  {
    Block scan;
    std::optional<Block> objects;
  };
  [[noreturn]] void fail(const char* what, int error) const;
  Block writeInPieces(const mrpt::obs::CObservation3DRangeScan& scan);
  Block write(const Bytes& bytes);
  Bytes read(const Block& block) const;

  std::string directory_;
  int descriptor_ = -1;
  std::uint64_t end_ = 0;
  std::vector<KeyframeBlocks> keyframes_;
};

}  // namespace quadmap
