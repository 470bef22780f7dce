#pragma once

namespace quadmap
{
/** Distance of the cells of the three grids [px of the input]. */
inline constexpr int kStrides[] = {8, 16, 32};

/** The cells of one distance over a network's input, row by row. */
struct Grid
{
  int columns = 0, rows = 0, stride = 1;

  static Grid of(int width, int height, int stride)
  {
    return {(width + stride - 1) / stride, (height + stride - 1) / stride, stride};
  }
  int cells() const { return columns * rows; }
};

/** Number of cells of all three grids. */
inline int cellsOfAllGrids(int width, int height)
{
  int cells = 0;
  for (const int stride : kStrides) cells += Grid::of(width, height, stride).cells();
  return cells;
}

}  // namespace quadmap
