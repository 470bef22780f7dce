#pragma once

#include "cloud/ObjectCloud.h"
#include "cloud/Precision.h"
#include "quadmap/obs/LabelTable.h"

namespace quadmap
{
/** Does the foot of an object seem to be out of sight, as that of a chair behind a table? It is of
 * a kind that stands on floors, no support of it is known, and it shows too little of its height.
 * \param spreadsTooLow Spreads of its kind by which what is seen is lower than usual. */
inline bool isFootOutOfSight(
    const ObjectCloud& object, const LabelProperties& label, double spreadsTooLow)
{
  return !object.support && label.support == UsualSupport::Floor && spreadsTooLow > kUsualSpreads;
}

}  // namespace quadmap
