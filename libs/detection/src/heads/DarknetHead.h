#pragma once

#include "heads/Head.h"

namespace quadmap
{
/** Reads the layers [yolo] and [region] of Darknet as OpenCV decodes them: one row per box with
 * centre and size as shares of the input, objectness, and the scores of the classes times
 * objectness. */
class DarknetHead : public Head
{
 public:
  DarknetHead(double width, double height, std::size_t labels) :
      width_(width), height_(height), labels_(labels)
  {
  }
  static constexpr int kBeforeScores = 5;  //!< Columns: x, y, width, height, objectness

  std::size_t labels() const override { return labels_; }
  std::vector<RawBox> rawBoxes(const std::vector<Tensor>& outputs, float minScore) const override;

 private:
  double width_, height_;  //!< Of the input [px]
  std::size_t labels_;
};

}  // namespace quadmap
