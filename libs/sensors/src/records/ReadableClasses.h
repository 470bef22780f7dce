#pragma once

#include <string>

namespace quadmap
{
/** Whether MRPT may read objects of a class whose layout is not known here, while memory and
 * nesting are limited. These are the classes that recordings and simple maps are made of, and what
 * they hold. MRPT has readers that these limits do not hold: one of meshes gives the bytes of a
 * record to a library that opens the files named there, and one of octrees calls itself without
 * reading.
 *
 * \param className Without namespaces. */
bool isReadByMrpt(const std::string& className);

}  // namespace quadmap
