#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace quadmap
{
/** A box as the decoders below give it, in pixels of the network's input. */
struct PlainBox
{
  double x1 = 0, y1 = 0, x2 = 0, y2 = 0;
  int label = 0;
  double score = 0;
  std::vector<double> coefficients;  //!< Of masks
};

/** The outputs of networks, decoded as their authors publish it, slowly and without any code of
 * quadmap. All take the boxes with at least this score, in the order of the output. */
namespace plain
{
/** A table of numbers, row by row. */
struct Table
{
  const float* data = nullptr;
  int rows = 0, columns = 0;

  double at(int row, int column) const { return static_cast<double>(data[row * columns + column]); }
};

/** YOLOX: rows of x y w h, objectness, scores; cells of 8, 16 and 32 pixels, row by row.
 *  centre = (xy + cell) * stride, size = exp(wh) * stride. */
std::vector<PlainBox> yolox(const Table& table, cv::Size input, double minScore);

/** YOLOv5: rows of x y w h [px], objectness, scores. */
std::vector<PlainBox> yolov5(const Table& table, double minScore);

/** YOLOv8: columns of x y w h [px], scores, so many coefficients. */
std::vector<PlainBox> yolov8(const Table& table, int coefficients, double minScore);

/** NanoDet, one grid of cells: side = stride * sum_k k softmax_k. */
std::vector<PlainBox> nanoDet(
    const Table& scores, const Table& sides, cv::Size input, int stride, double minScore);

/** Darknet's layer [yolo], from what the layer before gives: 3 anchors x (5 + classes) planes of
 *  cells. centre = (sigmoid(xy) + cell) / cells, size = exp(wh) * anchor; scores times objectness.
 *  \param anchors Their sizes [px of the input]. */
std::vector<PlainBox> darknet(
    const cv::Mat& planes, const std::vector<cv::Size2d>& anchors, cv::Size input, double minScore);

/** Darknet's table after its layer [yolo]: rows of x y w h as shares, objectness, scores. */
std::vector<PlainBox> darknetTable(const Table& table, cv::Size input, double minScore);

/** Of two boxes of a label that overlap more than this, the surer one stays. */
std::vector<PlainBox> withoutOverlaps(const std::vector<PlainBox>& boxes, double maxOverlap);

/** An image as it lies in a network's input: first pixel and scale. */
struct Letterbox
{
  cv::Mat canvas;  //!< Of the input's size, three channels of 8 bits
  double scaleX = 1, scaleY = 1, left = 0, top = 0;

  double imageX(double x) const { return (x - left) / scaleX; }
  double imageY(double y) const { return (y - top) / scaleY; }
};

Letterbox stretched(const cv::Mat& image, cv::Size input);
Letterbox letterboxed(const cv::Mat& image, cv::Size input, bool isCentred, int padding);

/** The sum of the prototypes of masks at a pixel of the image, between their pixels by bilinear
 * interpolation. The object is where it is positive.
 *  \param prototypes K x rows x columns, over the whole input. */
double maskSum(
    const cv::Mat& prototypes, const PlainBox& box, const Letterbox& place, int pixelX, int pixelY);

}  // namespace plain
}  // namespace quadmap
