#pragma once

#include <string>

#include "quadmap/review/PageContent.h"

namespace quadmap
{
/** Writes a picture with each confirmed object as its best image shows it: that of its largest box,
 * a completely measured one if there is any. Objects without a box in an image have a grey field,
 * doubtful ones a "?" behind their id.
 * The file appears complete or not at all. \exception std::runtime_error If it cannot be written.
 */
void writeContactSheet(const PageContent& content, const std::string& path);

}  // namespace quadmap
