#include "heads/HeadChoice.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "heads/DarknetHead.h"
#include "heads/DenseHead.h"
#include "heads/Grid.h"
#include "heads/NanoDetHead.h"

namespace quadmap
{
namespace
{
using HeadPtr = std::unique_ptr<Head>;

/** All outputs are tables of the same width. */
HeadPtr darknetHead(const HeadRequest& request)
{
  const auto& shapes = request.shapes;
  for (const Shape& shape : shapes)
    if (shape.size() != 2 || shape[1] != shapes[0][1] || shape[1] <= DarknetHead::kBeforeScores)
      return nullptr;
  const auto labels = static_cast<std::size_t>(shapes[0][1] - DarknetHead::kBeforeScores);
  return std::make_unique<DarknetHead>(request.width, request.height, labels);
}

/** Each grid has two tables. Networks differ in the order of their outputs and in their names, so
 * that the width tells the scores from the sides. */
HeadPtr nanoDetHead(const HeadRequest& request)
{
  const auto& shapes = request.shapes;
  std::array<NanoDetHead::GridOutputs, 3> grids;
  if (shapes.size() != 2 * grids.size()) return nullptr;
  const auto labels = static_cast<int>(request.labels);
  int bins = 0;
  for (std::size_t l = 0; l < grids.size(); ++l)
  {
    NanoDetHead::GridOutputs& part = grids[l];
    part.grid = Grid::of(request.width, request.height, kStrides[l]);
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < shapes.size(); ++i)
      if (shapes[i].size() == 2 && shapes[i][0] == part.grid.cells()) own.push_back(i);
    if (own.size() != 2) return nullptr;
    const bool scoresFirst = shapes[own[0]][1] == labels;
    part.scores = own[scoresFirst ? 0 : 1];
    part.sides = own[scoresFirst ? 1 : 0];
    const int sides = shapes[part.sides][1];
    if (sides < 8 || sides % 4 != 0 || (l > 0 && sides != 4 * bins)) return nullptr;
    bins = sides / 4;
    if (shapes[part.scores][1] != shapes[grids[0].scores][1] || sides == labels) return nullptr;
  }
  const auto classes = static_cast<std::size_t>(shapes[grids[0].scores][1]);
  return std::make_unique<NanoDetHead>(grids, classes, bins);
}

/** The index of the table and, with masks, of their prototypes. */
struct Outputs
{
  int table = 0, masks = -1, coefficients = 0;
};

std::optional<Outputs> denseOutputs(const std::vector<Shape>& shapes)
{
  if (shapes.size() == 1 && shapes[0].size() == 2) return Outputs{};
  if (shapes.size() != 2) return std::nullopt;
  const int table = shapes[0].size() == 2 ? 0 : 1, masks = 1 - table;
  const Shape& prototypes = shapes[static_cast<std::size_t>(masks)];
  if (shapes[static_cast<std::size_t>(table)].size() != 2 || prototypes.size() != 3)
    return std::nullopt;
  return Outputs{table, masks, prototypes[0]};
}

HeadPtr denseHead(const HeadRequest& request, HeadKind kind)
{
  const auto outputs = denseOutputs(request.shapes);
  if (!outputs) return nullptr;
  constexpr int kAnchorsOfYolov5 = 3;  // at each cell
  const int anchors = cellsOfAllGrids(request.width, request.height) *
                      (kind == HeadKind::Yolov5 ? kAnchorsOfYolov5 : 1);
  const Shape& table = request.shapes[static_cast<std::size_t>(outputs->table)];
  const bool inColumns = kind == HeadKind::Yolov8;
  const int labels = table[inColumns ? 0 : 1] - (inColumns ? 4 : 5) - outputs->coefficients;
  if (table[inColumns ? 1 : 0] != anchors || labels < 1) return nullptr;
  DenseHead::Layout layout;
  layout.kind = kind;
  layout.anchors = static_cast<std::size_t>(anchors);
  layout.labels = static_cast<std::size_t>(labels);
  layout.coefficients = static_cast<std::size_t>(outputs->coefficients);
  layout.width = request.width;
  layout.height = request.height;
  layout.table = outputs->table;
  layout.masks = outputs->masks;
  return std::make_unique<DenseHead>(layout);
}

HeadPtr headOf(const HeadRequest& request, HeadKind kind)
{
  if (request.shapes.empty()) return nullptr;
  if (kind == HeadKind::Darknet) return darknetHead(request);
  if (kind == HeadKind::NanoDet) return nanoDetHead(request);
  return denseHead(request, kind);
}

std::string textOfAll(const std::vector<Shape>& shapes)
{
  std::string text;
  for (const Shape& shape : shapes) text += (text.empty() ? "" : ", ") + textOf(shape);
  return text;
}

}  // namespace

Shape withoutBatch(Shape shape)
{
  while (shape.size() > 2 && shape.front() == 1) shape.erase(shape.begin());
  return shape;
}

std::string textOf(const Shape& shape)
{
  std::string text;
  for (const int side : shape) text += (text.empty() ? "" : "x") + std::to_string(side);
  return text;
}

std::pair<HeadKind, std::unique_ptr<Head>> chooseHead(const HeadRequest& request)
{
  // Darknet is not among them: its tables have no number of rows to be known by.
  std::vector<HeadKind> kinds{
      HeadKind::NanoDet, HeadKind::Yolov8, HeadKind::Yolox, HeadKind::Yolov5};
  if (request.kind != HeadKind::Auto) kinds = {request.kind};
  std::string tried;
  for (const HeadKind kind : kinds)
  {
    auto head = headOf(request, kind);
    tried += (tried.empty() ? "" : ", ") + std::string(nameOf(kind));
    if (!head) continue;
    if (head->labels() != request.labels)
      throw std::runtime_error(mrpt::format(
          "its outputs (%s) have %zu classes, but there are %zu labels",
          textOfAll(request.shapes).c_str(), head->labels(), request.labels));
    return {kind, std::move(head)};
  }
  throw std::runtime_error(mrpt::format(
      "its outputs (%s, for an input of %dx%d and %zu labels) are not those of %s",
      textOfAll(request.shapes).c_str(), request.width, request.height, request.labels,
      tried.c_str()));
}

}  // namespace quadmap
