#include "quadmap/benchmark/GeneratedSections.h"

#include <stdexcept>

namespace quadmap
{
std::string withGeneratedSections(
    const std::string& page,
    const std::map<std::string, std::string>& sections,
    const std::set<std::string>& kept)
{
  const std::string kBegin = "<!-- generated: ", kClose = " -->\n";
  std::string out;
  std::size_t at = 0;
  for (auto begin = page.find(kBegin); begin != std::string::npos; begin = page.find(kBegin, at))
  {
    const auto nameBegin = begin + kBegin.size(), nameEnd = page.find(kClose, nameBegin);
    if (nameEnd == std::string::npos) throw std::runtime_error("a marker is not closed by -->");
    const std::string name = page.substr(nameBegin, nameEnd - nameBegin);
    const auto end = page.find("<!-- end of " + name + " -->", nameEnd);
    if (end == std::string::npos)
      throw std::runtime_error("section " + name + ": no <!-- end of " + name + " -->");
    if (kept.count(name))
    {
      out += page.substr(at, end - at);
      at = end;
      continue;
    }
    const auto text = sections.find(name);
    if (text == sections.end())
      throw std::runtime_error("section " + name + ": nothing of this name is generated");
    out += page.substr(at, nameEnd + kClose.size() - at) + text->second;
    at = end;
  }
  return out + page.substr(at);
}

}  // namespace quadmap
