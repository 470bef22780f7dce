#pragma once

#include <map>
#include <set>
#include <string>

namespace quadmap
{
/** Puts texts between their markers, and leaves everything else of a page unchanged:
 *
 *     <!-- generated: NAME -->
 *     ...
 *     <!-- end of NAME -->
 *
 * Texts for which the page has no section are left out.
 * \exception std::runtime_error For a section without an end, and for a section of the page that
 * has no text.
 * \param kept Names of sections that stay as they are. */
std::string withGeneratedSections(
    const std::string& page,
    const std::map<std::string, std::string>& sections,
    const std::set<std::string>& kept = {});

}  // namespace quadmap
