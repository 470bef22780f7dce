#pragma once

#include <string>

#include "quadmap/review/PageContent.h"

namespace quadmap
{
/** Writes one HTML file that any browser opens from the disk. It holds everything: the data, the
 * program of the page (share/quadmap/page) and three.js. It asks no network for anything, and its
 * content security policy allows the scripts written here alone, by their hashes. What comes from
 * files is data for them, never markup. The file appears complete or not at all.
 * \param threeFolder Where three.js is installed (Debian: libjs-three).
 * \exception std::runtime_error If three.js is missing, or the file cannot be written. */
void writePage(const PageContent& content, const std::string& path, const std::string& threeFolder);

/** Where Debian's package libjs-three puts three.js. */
inline constexpr const char* kThreeFolder = "/usr/share/javascript/three";

}  // namespace quadmap
