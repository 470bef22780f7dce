#pragma once

#include <vector>

#include "heads/Head.h"

namespace quadmap
{
/** An output of a network that a test writes into. */
struct HandMadeTensor
{
  HandMadeTensor(const Shape& s, float value = 0) :
      shape(s), numbers(Tensor{s, nullptr}.size(), value)
  {
  }
  /** A number of a table. */
  float& at(int row, int column)
  {
    return numbers[static_cast<std::size_t>(row * shape[1] + column)];
  }
  Tensor tensor() const { return {shape, numbers.data()}; }

  Shape shape;
  std::vector<float> numbers;
};

}  // namespace quadmap
