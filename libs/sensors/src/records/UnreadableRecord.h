#pragma once

#include <exception>
#include <string>
#include <string_view>

namespace quadmap
{
/** Whether MRPT may have written this as the name of a class. */
bool isClassName(std::string_view name);

/** The class name at the head of a stored object. It is empty when there is none. */
std::string classNameIn(const std::string& head);

/** Why a stored object could not be read.
 * \param head Its first bytes, as far as they have been read.
 * \param failure Why reading the file failed; empty if it did not.
 * \param thrown What reading the object threw. */
std::string whyUnreadable(
    const std::string& head, const std::string& failure, const std::exception& thrown);

}  // namespace quadmap
