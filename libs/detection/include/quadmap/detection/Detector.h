#pragma once

#include <mrpt/img/CImage.h>

#include <memory>
#include <string>
#include <vector>

#include "quadmap/obs/DetectedObject.h"

namespace quadmap
{
/** Finds objects in colour images. */
class Detector
{
 public:
  virtual ~Detector() = default;

  /** The objects of an image, the surest first, with masks when the network makes some. The same
   * image gives the same objects, whatever the number of threads.
   * \param image 8 bits per channel, one channel or three (BGR). Boxes are in its pixels and end at
   * its borders.
   * \exception std::runtime_error If the network cannot look at the image; names its file. */
  virtual std::vector<DetectedObject> detect(const mrpt::img::CImage& image) = 0;

  /** One line for people: the model, what its outputs are, its labels and its input. */
  virtual std::string description() const = 0;
};

/** Loads a network and tries it on an empty image.
 * \param model Name of a known model (see knownDetectors()) or the path of a model file, which ends
 * in .ini.
 * \exception std::runtime_error For a model that is not known or not installed, files that are
 * damaged, outputs of no known kind, and labels of another number. The message names the file.
 * \exception std::invalid_argument For a model file with wrong values. */
std::unique_ptr<Detector> loadDetector(const std::string& model);

}  // namespace quadmap
