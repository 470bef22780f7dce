#pragma once

#include <stdexcept>

#include "quadmap/sensors/FrameSource.h"

namespace quadmap
{
/** A problem of the input. It ends the run, or is noted in a list when the run is to keep going. */
class InputError : public std::runtime_error
{
 public:
  explicit InputError(InputProblem p) : std::runtime_error(p.text()), problem(std::move(p)) {}
  InputProblem problem;
};

}  // namespace quadmap
