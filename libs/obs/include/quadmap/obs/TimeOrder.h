#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace quadmap
{
/** Why a time cannot be used among times that rise, as a phrase: "time 7.000000 s is not after the
 * pose before". When the two that follow agree with all before, but not with this one, this one is
 * wrong, and not all others.
 * \param last The last time before it that could be used [s], if there is one.
 * \param what What has these times, for the phrase: "pose". */
std::optional<std::string> whyOutOfOrder(
    const std::vector<double>& times,
    std::size_t i,
    const std::optional<double>& last,
    const char* what);

}  // namespace quadmap
