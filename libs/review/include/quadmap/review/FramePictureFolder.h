#pragma once

#include <mrpt/img/CImage.h>

#include <cstddef>
#include <string>

#include "quadmap/base/OutputGroup.h"

namespace quadmap
{
/** A folder for pictures of frames, frame-000000.jpg and so on: the pictures of a run appear
 * together in the place of those of an earlier one, or not at all. */
class FramePictureFolder
{
 public:
  /** \param folder It is made when missing, and removed again when no pictures appear.
   *  \param group What the pictures appear with when it is committed; null: they appear at once.
   *  \exception std::runtime_error If it cannot be made or written, or another program writes
   *  pictures into it. */
  explicit FramePictureFolder(const std::string& folder, OutputGroup* group = nullptr);

  /** \param frame Number of the frame, from 0; each has one picture.
   *  \exception std::runtime_error If the picture cannot be written. */
  void add(std::size_t frame, const mrpt::img::CImage& picture);

  /** Gives all pictures their names, unless a group does so, and removes the others of that form.
   *  Call it once.
   *  \exception std::runtime_error Names the file that cannot be written. */
  void commit();

 private:
  OutputGroup own_;
  OutputGroup* group_;
  OutputSet& files_;
};

}  // namespace quadmap
