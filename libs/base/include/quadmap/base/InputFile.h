#pragma once

#include <cstdint>
#include <fstream>
#include <string>

/** How files that somebody else wrote are opened. */
namespace quadmap
{
/** Folders from somebody else may have pipes, at which a reader would wait for ever, and devices
 * without an end. What does not exist is none of them.
 * \exception std::runtime_error If the file is a pipe, a socket or a device; names it. */
void requireNoDevice(const std::string& path);

/** Opens a text. Those that people write are small; larger ones would be in memory several times
 * over.
 * \exception std::runtime_error If the file has more bytes, is a pipe or a device, or cannot be
 * opened; names it. */
std::ifstream openModestText(
    const std::string& path, std::uintmax_t mostBytes = std::uintmax_t{1} << 20);

/** A file of numbers that was cut off within its last one is read with a shorter number. Other
 * programs may leave the last line break out, so that it is no error.
 * \return What to warn of, without the path, when a text ends within a line; else "". */
std::string warningOfCut(const std::string& path);

}  // namespace quadmap
