#pragma once

#include <string>
#include <string_view>

namespace quadmap
{
/** The 32 bytes of the SHA-256 digest (FIPS 180-4, section 6.2). Content security policies name
 * scripts by it. */
std::string sha256(std::string_view bytes);

}  // namespace quadmap
