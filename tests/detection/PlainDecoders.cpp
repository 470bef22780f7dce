#include "PlainDecoders.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace quadmap::plain
{
namespace
{
double sigmoid(double x) { return 1 / (1 + std::exp(-x)); }

PlainBox around(double x, double y, double width, double height)
{
  PlainBox box;
  box.x1 = x - width / 2;
  box.x2 = x + width / 2;
  box.y1 = y - height / 2;
  box.y2 = y + height / 2;
  return box;
}

/** Sets label and score to those of the best class. */
void setBest(PlainBox& box, const std::vector<double>& scores)
{
  box.label = -1;
  for (int c = 0; c < static_cast<int>(scores.size()); ++c)
    if (box.label < 0 || scores[static_cast<std::size_t>(c)] > box.score)
    {
      box.label = c;
      box.score = scores[static_cast<std::size_t>(c)];
    }
}

double overlap(const PlainBox& a, const PlainBox& b)
{
  const double width = std::min(a.x2, b.x2) - std::max(a.x1, b.x1);
  const double height = std::min(a.y2, b.y2) - std::max(a.y1, b.y1);
  if (width <= 0 || height <= 0) return 0;
  const double both = width * height;
  return both / ((a.x2 - a.x1) * (a.y2 - a.y1) + (b.x2 - b.x1) * (b.y2 - b.y1) - both);
}

}  // namespace

std::vector<PlainBox> yolox(const Table& table, cv::Size input, double minScore)
{
  std::vector<PlainBox> boxes;
  int row = 0;
  for (const int stride : {8, 16, 32})
    for (int cellY = 0; cellY < input.height / stride; ++cellY)
      for (int cellX = 0; cellX < input.width / stride; ++cellX, ++row)
      {
        PlainBox box = around(
            (table.at(row, 0) + cellX) * stride, (table.at(row, 1) + cellY) * stride,
            std::exp(table.at(row, 2)) * stride, std::exp(table.at(row, 3)) * stride);
        std::vector<double> scores;
        for (int c = 5; c < table.columns; ++c)
          scores.push_back(table.at(row, 4) * table.at(row, c));
        setBest(box, scores);
        if (box.score >= minScore) boxes.push_back(box);
      }
  return boxes;
}

std::vector<PlainBox> yolov5(const Table& table, double minScore)
{
  std::vector<PlainBox> boxes;
  for (int row = 0; row < table.rows; ++row)
  {
    PlainBox box = around(table.at(row, 0), table.at(row, 1), table.at(row, 2), table.at(row, 3));
    std::vector<double> scores;
    for (int c = 5; c < table.columns; ++c) scores.push_back(table.at(row, 4) * table.at(row, c));
    setBest(box, scores);
    if (box.score >= minScore) boxes.push_back(box);
  }
  return boxes;
}

std::vector<PlainBox> yolov8(const Table& table, int coefficients, double minScore)
{
  std::vector<PlainBox> boxes;
  for (int column = 0; column < table.columns; ++column)
  {
    PlainBox box =
        around(table.at(0, column), table.at(1, column), table.at(2, column), table.at(3, column));
    std::vector<double> scores;
    for (int row = 4; row < table.rows - coefficients; ++row)
      scores.push_back(table.at(row, column));
    setBest(box, scores);
    for (int row = table.rows - coefficients; row < table.rows; ++row)
      box.coefficients.push_back(table.at(row, column));
    if (box.score >= minScore) boxes.push_back(box);
  }
  return boxes;
}

std::vector<PlainBox> nanoDet(
    const Table& scores, const Table& sides, cv::Size input, int stride, double minScore)
{
  std::vector<PlainBox> boxes;
  const int cellsInRow = (input.width + stride - 1) / stride, bins = sides.columns / 4;
  for (int cell = 0; cell < scores.rows; ++cell)
  {
    double side[4];
    for (int s = 0; s < 4; ++s)
    {
      double sum = 0, weighted = 0;
      for (int k = 0; k < bins; ++k)
      {
        const double share = std::exp(sides.at(cell, s * bins + k));
        sum += share;
        weighted += k * share;
      }
      side[s] = stride * weighted / sum;
    }
    const double x = (cell % cellsInRow + 0.5) * stride - 0.5;
    const double y = (cell / cellsInRow + 0.5) * stride - 0.5;
    PlainBox box;
    box.x1 = x - side[0];
    box.y1 = y - side[1];
    box.x2 = x + side[2];
    box.y2 = y + side[3];
    std::vector<double> all;
    for (int c = 0; c < scores.columns; ++c) all.push_back(scores.at(cell, c));
    setBest(box, all);
    if (box.score >= minScore) boxes.push_back(box);
  }
  return boxes;
}

std::vector<PlainBox> darknet(
    const cv::Mat& planes, const std::vector<cv::Size2d>& anchors, cv::Size input, double minScore)
{
  std::vector<PlainBox> boxes;
  const int perAnchor = planes.size[1] / static_cast<int>(anchors.size());
  const int rows = planes.size[2], columns = planes.size[3];
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      for (int a = 0; a < static_cast<int>(anchors.size()); ++a)
      {
        const auto at = [&](int plane)
        {
          const int index[] = {0, a * perAnchor + plane, y, x};
          return static_cast<double>(planes.at<float>(index));
        };
        const cv::Size2d& anchor = anchors[static_cast<std::size_t>(a)];
        PlainBox box = around(
            (sigmoid(at(0)) + x) / columns * input.width,
            (sigmoid(at(1)) + y) / rows * input.height, std::exp(at(2)) * anchor.width,
            std::exp(at(3)) * anchor.height);
        std::vector<double> scores;
        for (int c = 5; c < perAnchor; ++c) scores.push_back(sigmoid(at(4)) * sigmoid(at(c)));
        setBest(box, scores);
        if (box.score >= minScore) boxes.push_back(box);
      }
  return boxes;
}

std::vector<PlainBox> darknetTable(const Table& table, cv::Size input, double minScore)
{
  std::vector<PlainBox> boxes;
  for (int row = 0; row < table.rows; ++row)
  {
    PlainBox box = around(
        table.at(row, 0) * input.width, table.at(row, 1) * input.height,
        table.at(row, 2) * input.width, table.at(row, 3) * input.height);
    std::vector<double> scores;
    for (int c = 5; c < table.columns; ++c) scores.push_back(table.at(row, c));
    setBest(box, scores);
    if (box.score >= minScore) boxes.push_back(box);
  }
  return boxes;
}

std::vector<PlainBox> withoutOverlaps(const std::vector<PlainBox>& boxes, double maxOverlap)
{
  std::vector<bool> isLeft(boxes.size(), true);
  std::vector<PlainBox> kept;
  while (true)
  {
    std::size_t best = boxes.size();
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (isLeft[i] && (best == boxes.size() || boxes[i].score > boxes[best].score)) best = i;
    if (best == boxes.size()) return kept;
    kept.push_back(boxes[best]);
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (i == best ||
          (boxes[i].label == boxes[best].label && overlap(boxes[i], boxes[best]) > maxOverlap))
        isLeft[i] = false;
  }
}

Letterbox stretched(const cv::Mat& image, cv::Size input)
{
  Letterbox place;
  cv::resize(image, place.canvas, input);
  place.scaleX = static_cast<double>(input.width) / image.cols;
  place.scaleY = static_cast<double>(input.height) / image.rows;
  return place;
}

Letterbox letterboxed(const cv::Mat& image, cv::Size input, bool isCentred, int padding)
{
  Letterbox place;
  const double scale = std::min(
      static_cast<double>(input.width) / image.cols,
      static_cast<double>(input.height) / image.rows);
  const cv::Size size(
      static_cast<int>(std::lround(image.cols * scale)),
      static_cast<int>(std::lround(image.rows * scale)));
  cv::Mat scaled;
  cv::resize(image, scaled, size);
  const int left = isCentred ? (input.width - size.width) / 2 : 0;
  const int top = isCentred ? (input.height - size.height) / 2 : 0;
  cv::copyMakeBorder(
      scaled, place.canvas, top, input.height - size.height - top, left,
      input.width - size.width - left, cv::BORDER_CONSTANT, cv::Scalar::all(padding));
  place.scaleX = place.scaleY = scale;
  place.left = left;
  place.top = top;
  return place;
}

double maskSum(
    const cv::Mat& prototypes, const PlainBox& box, const Letterbox& place, int pixelX, int pixelY)
{
  const int count = prototypes.size[1], rows = prototypes.size[2], columns = prototypes.size[3];
  const auto at = [&](int row, int column)
  {
    double sum = 0;
    for (int k = 0; k < count; ++k)
    {
      const int index[] = {0, k, std::clamp(row, 0, rows - 1), std::clamp(column, 0, columns - 1)};
      sum += box.coefficients[static_cast<std::size_t>(k)] *
             static_cast<double>(prototypes.at<float>(index));
    }
    return sum;
  };
  // The middle of the pixel in the input, then in prototypes counted from the middle of the first.
  const double x = ((pixelX + 0.5) * place.scaleX + place.left) * columns / place.canvas.cols - 0.5;
  const double y = ((pixelY + 0.5) * place.scaleY + place.top) * rows / place.canvas.rows - 0.5;
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const double right = x - column, below = y - row;
  return (1 - below) * ((1 - right) * at(row, column) + right * at(row, column + 1)) +
         below * ((1 - right) * at(row + 1, column) + right * at(row + 1, column + 1));
}

}  // namespace quadmap::plain
