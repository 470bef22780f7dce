#pragma once

#include <string>

#include "quadmap/review/PageContent.h"

namespace quadmap
{
/** The page's data as JSON in which no character has a meaning in HTML: <, >, & and all that is not
 * ASCII are written as \uXXXX. Image i is in the text as "jpeg", base64. */
std::string pageJson(const PageContent& content);

/** The points of the cloud in a fixed random order, so that the first n of them show all of it.
 * Little endian: for each point x, y, z as uint16 in steps of the cloud's `step` from its `origin`
 * (both are in the JSON), then for each point r, g, b, then for each the normal as int8, times 127.
 */
std::string pageCloud(const Cloud& cloud);

/** Makes a script safe inside of <script>: what would end or hide it is written otherwise, with the
 * same meaning in strings, regular expressions and comments.
 * \exception std::runtime_error If it cannot be: `a<!--b` as code. Names the script. */
std::string safeScript(const std::string& script, const std::string& name);

}  // namespace quadmap
