#pragma once

#include "heads/Head.h"
#include "heads/HeadChoice.h"

namespace quadmap
{
/** Reads the networks that give one table with a box per anchor: YOLOX, YOLOv5, YOLOv8 and YOLO11.
 *
 *   YOLOX   anchors x (x y w h, objectness, scores), where x y w h are in cells: (21.2) of
 *           doc/mathematics.md
 *   YOLOv5  anchors x (x y w h [px of the input], objectness, scores)
 *   YOLOv8  (x y w h [px of the input], scores, coefficients of the mask) x anchors
 *
 * The score of a box is that of its best class, times objectness where there is one. */
class DenseHead : public Head
{
 public:
  struct Layout
  {
    HeadKind kind = HeadKind::Yolov8;
    std::size_t anchors = 0, labels = 0, coefficients = 0;
    int width = 0, height = 0;  //!< Of the network's input [px]
    int table = 0, masks = -1;  //!< Indices of the outputs; -1 without masks
  };

  explicit DenseHead(const Layout& layout) : layout_(layout) {}

  std::size_t labels() const override { return layout_.labels; }
  std::vector<RawBox> rawBoxes(const std::vector<Tensor>& outputs, float minScore) const override;
  int maskOutput() const override { return layout_.masks; }

 private:
  bool hasObjectness() const { return layout_.kind != HeadKind::Yolov8; }
  std::size_t firstScore() const { return hasObjectness() ? 5 : 4; }
  float value(const float* table, std::size_t anchor, std::size_t column) const;
  RawBox rawBoxOf(const float* table, std::size_t anchor) const;
  ImageBox boxOf(const float* table, std::size_t anchor) const;

  Layout layout_;
};

}  // namespace quadmap
