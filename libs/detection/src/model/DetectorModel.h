#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "Letterbox.h"
#include "heads/HeadChoice.h"
#include "quadmap/base/OptionGroup.h"

namespace quadmap
{
/** A file that a model needs. */
struct ModelPart
{
  std::string file;    //!< Name; absolute, or in the model file's folder or detectorFolder()
  std::string url;     //!< Where to get it; may be empty
  std::string sha256;  //!< 64 hexadecimal digits; empty when not known
};

/** How a network is fed and read, as section [detector] of a model file. */
struct DetectorModel : public OptionGroup
{
  ModelPart weights;  //!< .onnx, or .weights of Darknet
  ModelPart network;  //!< .cfg of Darknet; without a name for .onnx
  std::string labels = "coco.names";
  HeadKind head = HeadKind::Auto;
  int width = 640, height = 640;  //!< Of the network's input [px]
  Fit fit = Fit::Centre;
  double padding = 114;
  ChannelOrder channels = ChannelOrder::Rgb;
  std::array<double, 3> mean{0, 0, 0};
  std::array<double, 3> deviation{255, 255, 255};
  double minScore = 0.25;
  double maxOverlap = 0.45;
  std::string licence = "unknown";

  /** Reads a model file.
   *  \exception std::runtime_error If it cannot be read.
   *  \exception std::invalid_argument For wrong values. Both messages start with its name. */
  static DetectorModel fromFile(const std::string& path);

  bool isDarknet() const { return !network.file.empty(); }

  /** Its files, the network's plan first. */
  std::vector<ModelPart> parts() const;

 private:
  void describe(OptionList& list) override;
};

}  // namespace quadmap
