#pragma once

#include <string>

namespace quadmap
{
/** Full path of a data file of the project ("labels.ini", "scenes/home.ini"): looked up in
 * $QUADMAP_SHARE_DIR, then ../share/quadmap beside the library, then the source tree.
 * \exception std::runtime_error If there is no such file; names the places tried. */
std::string findShareFile(const std::string& name);

}  // namespace quadmap
