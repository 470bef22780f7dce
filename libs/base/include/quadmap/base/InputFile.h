#pragma once

#include <cstdint>
#include <string>

/** What is checked of a file before it is opened. */
namespace quadmap
{
/** Folders from somebody else may have pipes, at which a reader would wait for ever, and devices
 * without an end. What does not exist is none of them.
 * \exception std::runtime_error If the file is a pipe, a socket or a device; names it. */
void requireNoDevice(const std::string& path);

/** Texts that people write are small. Larger ones are read into memory several times over.
 * \exception std::runtime_error If the file has more bytes, or is a pipe or a device; names it. */
void requireModestText(const std::string& path, std::uintmax_t mostBytes = std::uintmax_t{1} << 20);

}  // namespace quadmap
