#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "../obs/TemporaryFolder.h"

namespace quadmap
{
/** A network of Darknet that needs no training: it sees a thing where an image is red. It looks at
 * squares of 8 pixels of an input of 64 x 64 and gives each red one a box of 16 x 16 pixels around
 * its centre, of score 1 and of the first of its two labels, "chair" and "cup". */
struct TinyDetector
{
  TemporaryFolder folder;

  TinyDetector()
  {
    folder.write(
        "tiny.cfg",
        "[net]\nwidth=64\nheight=64\nchannels=3\n\n"
        "[convolutional]\nfilters=7\nsize=8\nstride=8\npad=0\nactivation=linear\n\n"
        "[yolo]\nmask=0\nanchors=16,16\nclasses=2\nnum=1\n");
    folder.write("tiny.names", "chair\ncup\n");
    folder.write("tiny.weights", weights());
    folder.write("tiny.ini", ini());
  }

  std::string model() const { return folder.path("tiny.ini"); }

  static std::string ini()
  {
    return "[detector]\nweights = tiny.weights\nnetwork = tiny.cfg\nlabels = tiny.names\n"
           "width = 64\nheight = 64\nfit = stretch\nchannels = rgb\n";
  }

  static std::string weights()
  {
    constexpr int kOutputs = 7, kObjectness = 4, kSquare = 8 * 8;
    std::vector<float> numbers{0, 0, 0, 0, -20, 20, -20};  // biases: x y w h, objectness, labels
    for (int output = 0; output < kOutputs; ++output)
      for (int channel = 0; channel < 3; ++channel)
        for (int pixel = 0; pixel < kSquare; ++pixel)
          numbers.push_back(output == kObjectness ? (channel == 0 ? 60.f : -60.f) / kSquare : 0);
    const std::int32_t header[] = {0, 2, 0, 0, 0};
    return std::string(reinterpret_cast<const char*>(header), sizeof header) +
           std::string(
               reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float));
  }
};

}  // namespace quadmap
