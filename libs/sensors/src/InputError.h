#pragma once

#include <stdexcept>

#include "quadmap/sensors/RawlogSource.h"

namespace quadmap
{
/** A problem on its way to whoever decides: the user (strict) or the list (keep going). */
class InputError : public std::runtime_error
{
 public:
  explicit InputError(InputProblem p) : std::runtime_error(p.text()), problem(std::move(p)) {}
  InputProblem problem;
};

}  // namespace quadmap
