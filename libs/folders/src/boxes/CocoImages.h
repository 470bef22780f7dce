#pragma once

#include <map>
#include <string>
#include <vector>

#include "quadmap/obs/DetectedObject.h"

namespace quadmap
{
/** The boxes of a file of COCO by its images, which it names with as much of their path as the
 * writer thought fit: "a.jpg", "left/a.jpg", "/data/room/left/a.jpg", or a number. */
class CocoImages
{
 public:
  using Boxes = std::vector<DetectedObject>;

  /** \param file For messages. */
  explicit CocoImages(std::string file) : file_(std::move(file)) {}

  /** The boxes of an image, none at first. \param image As the file names it. */
  Boxes& of(const std::string& image);

  bool empty() const { return folders_.empty(); }

  /** Whether the file has an image that may be this one. \param names See find(). */
  bool has(const std::string& path, const std::vector<std::string>& names) const
  {
    return !candidates(path, names).empty();
  }

  /** The boxes of an image of the recording, or null. Of images with equal names it is the one
   * whose path has the most folders at its end in common with the image's; one without folders may
   * be any.
   * \param path The image's file.
   * \param names What it may be called, without folder and extension; the first that is there
   * counts. \exception std::runtime_error If several may be it. The message names them. */
  const Boxes* find(const std::string& path, const std::vector<std::string>& names) const;

 private:
  /** An image of the file: its name with its folder, and its boxes. */
  using Image = std::pair<std::string, const Boxes*>;
  std::vector<Image> candidates(
      const std::string& path, const std::vector<std::string>& names) const;

  std::string file_;
  std::map<std::string, std::map<std::string, Boxes>> folders_;  // by names without extension
};

}  // namespace quadmap
