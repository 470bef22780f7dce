#pragma once

#include <memory>
#include <vector>

#include "heads/Head.h"

namespace quadmap
{
/** The kinds of outputs that are known. */
enum class HeadKind
{
  Auto,     //!< To be told from the shapes
  Darknet,  //!< YOLOv3, v4 and Yolo-Fastest, decoded by OpenCV
  NanoDet,
  Yolox,
  Yolov5,
  Yolov8  //!< And YOLO11; both also with masks
};

/** The name in a model file. */
const char* nameOf(HeadKind kind);

/** What the choice of a head may depend on. */
struct HeadRequest
{
  HeadKind kind = HeadKind::Auto;
  std::vector<Shape> shapes;  //!< Of the outputs, without leading ones
  int width = 0, height = 0;  //!< Of the network's input [px]
  std::size_t labels = 0;     //!< Number of known labels
};

/** A head that reads such outputs, and its kind.
 * \exception std::runtime_error If none does, or its classes are not as many as the labels. The
 * message has the shapes. */
std::pair<HeadKind, std::unique_ptr<Head>> chooseHead(const HeadRequest& request);

}  // namespace quadmap
