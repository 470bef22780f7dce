#include "heads/DenseHead.h"

#include <cmath>

#include "heads/Grid.h"

namespace quadmap
{
namespace
{
/** The cell of an anchor: its column and row, and the distance of the cells [px]. */
struct Cell
{
  int column = 0, row = 0, stride = 1;
};

Cell cellOf(std::size_t anchor, int width, int height)
{
  int index = static_cast<int>(anchor);
  for (const int stride : kStrides)
  {
    const Grid grid = Grid::of(width, height, stride);
    if (index < grid.cells()) return {index % grid.columns, index / grid.columns, stride};
    index -= grid.cells();
  }
  return {};
}

}  // namespace

float DenseHead::value(const float* table, std::size_t anchor, std::size_t column) const
{
  const std::size_t columns = firstScore() + layout_.labels + layout_.coefficients;
  return layout_.kind == HeadKind::Yolov8 ? table[column * layout_.anchors + anchor]
                                          : table[anchor * columns + column];
}

std::vector<RawBox> DenseHead::rawBoxes(const std::vector<Tensor>& outputs, float minScore) const
{
  const float* table = outputs[static_cast<std::size_t>(layout_.table)].data;
  std::vector<RawBox> found;
  // Most anchors see nothing. Which do is found in the order of memory.
  std::vector<bool> isSeen(layout_.anchors, hasObjectness());
  for (std::size_t c = 0; c < layout_.labels && !hasObjectness(); ++c)
  {
    const float* scores = table + (firstScore() + c) * layout_.anchors;
    for (std::size_t a = 0; a < layout_.anchors; ++a)
      if (scores[a] >= minScore) isSeen[a] = true;
  }
  for (std::size_t a = 0; a < layout_.anchors; ++a)
  {
    if (!isSeen[a] || (hasObjectness() && !(value(table, a, 4) >= minScore))) continue;
    RawBox rawBox = rawBoxOf(table, a);
    if (rawBox.score >= minScore) found.push_back(std::move(rawBox));
  }
  return found;
}

RawBox DenseHead::rawBoxOf(const float* table, std::size_t anchor) const
{
  RawBox rawBox;
  rawBox.box = boxOf(table, anchor);
  for (std::size_t c = 0; c < layout_.labels; ++c)
  {
    const float score = value(table, anchor, firstScore() + c);
    if (c > 0 && !(score > rawBox.score)) continue;
    rawBox.score = score;
    rawBox.label = c;
  }
  if (hasObjectness()) rawBox.score *= value(table, anchor, 4);
  for (std::size_t k = 0; k < layout_.coefficients; ++k)
    rawBox.maskCoefficients.push_back(value(table, anchor, firstScore() + layout_.labels + k));
  return rawBox;
}

ImageBox DenseHead::boxOf(const float* table, std::size_t anchor) const
{
  double x = value(table, anchor, 0), y = value(table, anchor, 1);
  double width = value(table, anchor, 2), height = value(table, anchor, 3);
  if (layout_.kind == HeadKind::Yolox)
  {
    const Cell cell = cellOf(anchor, layout_.width, layout_.height);
    x = (x + cell.column) * cell.stride;
    y = (y + cell.row) * cell.stride;
    width = std::exp(width) * cell.stride;
    height = std::exp(height) * cell.stride;
  }
  return {x - width / 2, y - height / 2, x + width / 2, y + height / 2};
}

}  // namespace quadmap
