#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/** What OutputFile and OutputSet share. */
namespace quadmap
{
/** \exception std::runtime_error Always: this path, and the text of errno. */
[[noreturn]] void failToWrite(const std::string& path, int error);

/** A path, and where it leads, link by link. The last one is no link, unless there are more of them
 * than Linux follows. */
std::vector<std::filesystem::path> linkChain(const std::filesystem::path& path);

/** What a path stands for: the target of a link. */
std::filesystem::path withoutLink(const std::filesystem::path& path);

/** Where a path leads when all links are followed, also to what does not exist yet. */
std::filesystem::path placeOf(const std::filesystem::path& path, std::error_code& error);

/** A device or pipe: it cannot be replaced, only be written to. */
bool isDevice(const std::filesystem::path& path);

/** Permission bits of a file that exists. */
std::optional<mode_t> permissionsOf(const std::filesystem::path& path);

/** Makes what happened to the names in a folder survive a power cut. */
void syncFolder(const std::filesystem::path& folder);

}  // namespace quadmap
