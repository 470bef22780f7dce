#pragma once

#include "PlaceEvidence.h"

namespace quadmap
{
/** Of the pairs that fix a place, those that agree with the others: doc/mathematics.md, (19.5) and
 * (19.6). What was moved by a few sigmas still passes the gate of a pair, and pulls the place
 * towards itself. The others tell how near the pairs of this place are, and where the object would
 * be.
 * \param place Where the pairs are best, and in return where those that are left are. */
Pairs consistentPairs(const PlaceEvidence& evidence, Pairs pairs, Place& place);

}  // namespace quadmap
