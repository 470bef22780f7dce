#pragma once

#include <string>
#include <vector>

namespace quadmap
{
/** Notes why a line of a file, or a file of a folder, cannot be used.
 * \param unusable Those so far of this file or folder.
 * \exception std::runtime_error If they are so many that it is of another kind. */
void noteUnusable(
    std::vector<std::string>& unusable, const std::string& file, const std::string& why);

}  // namespace quadmap
