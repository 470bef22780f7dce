#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadmap/folders/FrameFolder.h"
#include "quadmap/obs/DetectedObject.h"

namespace quadmap
{
/** The boxes that a detector wrote to files, in one form. */
class BoxReader
{
 public:
  virtual ~BoxReader() = default;

  /** The boxes of an image [px of that image]; nothing when the detector did not look at it.
   *  \exception std::runtime_error For a malformed file. The message names file and line. */
  virtual std::optional<std::vector<DetectedObject>> boxes(
      const FolderFrame& frame, const mrpt::img::TCamera& camera) const = 0;

  /** Whether all boxes of one file for all images are of images that are not among these. With a
   * file per image this is not known, as boxes() tells which file is missing. */
  virtual bool isOfOtherImages(const std::vector<FolderFrame>& /*frames*/) const { return false; }

  /** The file that has or should have the boxes of an image, and where in it, for messages. */
  virtual std::string fileOf(const FolderFrame& frame) const = 0;
  /** Where each box of boxes() stands: file and line, for messages. Empty in a form without lines,
   * where fileOf() tells the place. */
  virtual std::vector<std::string> placesOf(const FolderFrame& /*frame*/) const { return {}; }
  virtual std::string description() const = 0;  //!< Form and place, for messages
  /** What is taken for granted and may be wrong; empty when nothing is. */
  virtual std::string note() const { return {}; }
};

/** The names that boxes of an image may go by: that of its file without the extension, and in
 * 7-Scenes, whose images are NAME.color.png, also NAME. */
std::vector<std::string> namesOf(const FolderFrame& frame);

/** A reader for what is there: files of boxes in the project's own form or in that of YOLO's
 * save_txt, or a JSON file of COCO.
 * \param place Folder of text files, or the JSON file.
 * \param labels See FrameFolderOptions.
 * \exception std::runtime_error If they cannot be read, or their form is none of these. */
std::unique_ptr<const BoxReader> openBoxes(const std::string& place, const std::string& labels);

}  // namespace quadmap
