#pragma once

#include <filesystem>

namespace quadmap
{
/** Whether a path stays in a folder when all links are followed. Folders may come from somebody
 * else, with links to what their receiver alone may read or write. The path need not exist. What
 * cannot be followed, as a circle of links, is not inside. */
bool isInside(const std::filesystem::path& path, const std::filesystem::path& folder);

/** Folders from somebody else may have pipes, at which a reader would wait for ever, and devices
 * without an end. To be called before such a file is opened. What does not exist is none of them.
 * \exception std::runtime_error If the file is a pipe, a socket or a device; names it. */
void requireNoDevice(const std::filesystem::path& path);

}  // namespace quadmap
