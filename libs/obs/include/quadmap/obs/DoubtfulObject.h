#pragma once

#include "quadmap/obs/ObjectList.h"

namespace quadmap
{
/** Whether a map is not sure that an object exists: with a probability below 0.9. */
inline bool isDoubtful(const ObjectRecord& record) { return record.existence.value_or(1) < 0.9; }

}  // namespace quadmap
