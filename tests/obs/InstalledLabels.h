#pragma once

#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** Labels as the programs know them. */
inline const LabelTable& labels()
{
  static const LabelTable table = LabelTable::installed();
  return table;
}
}  // namespace quadmap
