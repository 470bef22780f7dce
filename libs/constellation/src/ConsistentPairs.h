#pragma once

#include "PlaceEvidence.h"

namespace quadmap
{
/** Those pairs of a place that agree with the others: doc/mathematics.md, (19.5) and (19.6). An
 * object that was moved by a few sigmas passes the gate of a pair, and pulls the place towards
 * itself. The other pairs tell where it would be, and by how much the pairs of this place differ.
 * \param place Where all pairs agree best. It becomes the place where those returned do. */
Pairs consistentPairs(const PlaceEvidence& evidence, Pairs pairs, Place& place);

}  // namespace quadmap
