#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "quadmap/obs/DetectedObject.h"

namespace quadmap
{
/** The boxes of a file of COCO by its images, which it names with as much of their path as the
 * writer thought fit: "a.jpg", "left/a.jpg", "/data/room/left/a.jpg", or a number.
 *
 * Of images with equal names the one is meant whose path has the most folders at its end in common
 * with that of the recording's image, and of equals the one all of whose folders agree. A folder
 * that differs and in which an image was not meant is of another recording or camera, and so are
 * all its images. */
class CocoImages
{
 public:
  using Boxes = std::vector<DetectedObject>;
  struct Image
  {
    std::string written;  //!< Its name, as the file has it
    Boxes boxes;
    std::optional<std::pair<double, double>> size;  //!< Width and height, if the file tells [px]
  };

  /** \param file For messages. */
  explicit CocoImages(std::string file) : file_(std::move(file)) {}

  /** An image, which has no boxes at first. \param image As the file names it. */
  Image& of(const std::string& image);

  bool empty() const { return images_.empty(); }

  /** Whether the file has an image that may be this one. \param names See find(). */
  bool has(const std::string& path, const std::vector<std::string>& names) const
  {
    return !candidates(path, names).empty();
  }

  /** What the file has of an image of the recording, or null. Not for several threads at a time.
   * \param path The image's file.
   * \param names What it may be called, without folder and extension; the first that is there
   * counts. \exception std::runtime_error If several may be it. The message names them. */
  const Image* find(const std::string& path, const std::vector<std::string>& names) const;

 private:
  using Meant = std::map<std::string, std::vector<const Image*>>;  // by names without extension

  Meant imagesMeantIn(const std::string& folder) const;
  std::vector<const Image*> candidates(
      const std::string& path, const std::vector<std::string>& names) const;

  std::string file_;
  std::map<std::string, std::map<std::string, Image>> images_;  // by name, then by folder
  mutable std::map<std::string, Meant> meant_;  // by the folders that were asked for so far
};

}  // namespace quadmap
