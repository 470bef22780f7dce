#pragma once

#include <cstddef>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "quadmap/geometry/ImageBox.h"

namespace quadmap
{
using Shape = std::vector<int>;

/** The same without leading ones: 1x84x8400 as 84x8400. */
Shape withoutBatch(Shape shape);

/** "84x8400". */
std::string textOf(const Shape& shape);

/** One output of a network. The numbers belong to the network. */
struct Tensor
{
  Shape shape;  //!< Without leading ones
  const float* data = nullptr;

  std::size_t size() const
  {
    return std::accumulate(
        shape.begin(), shape.end(), std::size_t{1},
        [](std::size_t n, int side) { return n * static_cast<std::size_t>(side); });
  }
};

/** A box before overlapping ones are removed. */
struct RawBox
{
  ImageBox box;           //!< In pixels of the network's input
  std::size_t label = 0;  //!< Number of the class
  float score = 0;
  std::vector<float> maskCoefficients;  //!< Of the prototypes of masks; empty without masks
};

/** What a network's outputs mean. */
class Head
{
 public:
  virtual ~Head() = default;

  virtual std::size_t labels() const = 0;  //!< Number of classes

  /** The boxes with at least this score, in the order of the outputs. Shapes are those that the
   *  head was made for. */
  virtual std::vector<RawBox> rawBoxes(
      const std::vector<Tensor>& outputs, float minScore) const = 0;

  /** Index of the output with the prototypes of masks, -1 when there is none. Its shape is
   *  coefficients x height x width, over the whole input. */
  virtual int maskOutput() const { return -1; }
};

}  // namespace quadmap
