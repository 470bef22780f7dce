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
 * The distance of a side is stride * sum(k * softmax_k) ["Generalized Focal Loss", Li et al.,
 * 2020]; the centre of cell i is at (i + 0.5) stride - 0.5. */
class NanoDetHead : public Head
{
 public:
  struct Level
  {
    Grid grid;
    std::size_t scores = 0, sides = 0;  //!< Indices of its two outputs
  };

  NanoDetHead(const std::array<Level, 3>& levels, std::size_t labels, int bins) :
      levels_(levels), labels_(labels), bins_(bins)
  {
  }

  std::size_t labels() const override { return labels_; }
  std::vector<Candidate> candidates(
      const std::vector<Tensor>& outputs, float minScore) const override;

 private:
  ImageBox boxOf(const Grid& grid, int cell, const float* logits) const;
  double distance(const float* logits) const;

  std::array<Level, 3> levels_;
  std::size_t labels_;
  int bins_;
};

}  // namespace quadmap
