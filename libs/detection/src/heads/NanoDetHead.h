#pragma once

#include <array>

#include "heads/Grid.h"
#include "heads/Head.h"

namespace quadmap
{
/** Reads NanoDet: for each of three grids the scores of the classes (cells x classes) and, for each
 * side of the box, the probabilities of its distance from the cell in a number of bins, as
 * logarithms (cells x 4 bins).
 *
 * Distances and centres: doc/mathematics.md, (21.1). */
class NanoDetHead : public Head
{
 public:
  struct GridOutputs
  {
    Grid grid;
    std::size_t scores = 0, sides = 0;  //!< Indices of its two outputs
  };

  NanoDetHead(const std::array<GridOutputs, 3>& grids, std::size_t labels, int bins) :
      grids_(grids), labels_(labels), bins_(bins)
  {
  }

  std::size_t labels() const override { return labels_; }
  std::vector<RawBox> rawBoxes(const std::vector<Tensor>& outputs, float minScore) const override;

 private:
  ImageBox boxOf(const Grid& grid, int cell, const float* logits) const;
  double distance(const float* logits) const;

  std::array<GridOutputs, 3> grids_;
  std::size_t labels_;
  int bins_;
};

}  // namespace quadmap
