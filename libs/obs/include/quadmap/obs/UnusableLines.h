#pragma once

#include <string>
#include <vector>

namespace quadmap
{
/** Notes why a line of a file cannot be used.
 * \param unusable Those of this file so far.
 * \exception std::runtime_error If they are so many that the file is of another kind. */
void noteUnusable(
    std::vector<std::string>& unusable, const std::string& file, const std::string& why);

}  // namespace quadmap
