#pragma once

#include "quadmap/obs/ObjectList.h"

namespace quadmap
{
/** Objects that exist with a smaller probability are doubtful. */
inline constexpr double kSureExistence = 0.9;

/** Whether a map is not sure that an object exists. */
inline bool isDoubtful(const ObjectRecord& record)
{
  return record.existence.value_or(1) < kSureExistence;
}

}  // namespace quadmap
