#pragma once

#include <filesystem>

namespace quadmap
{
/** Whether a path stays in a folder when all links are followed. Folders may come from somebody
 * else, with links to what their receiver alone may read or write. The path need not exist.
 * \exception std::runtime_error If it cannot be followed, as a circle of links; says why. */
bool isInside(const std::filesystem::path& path, const std::filesystem::path& folder);

}  // namespace quadmap
