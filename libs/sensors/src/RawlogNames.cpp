#include "quadmap/sensors/RawlogNames.h"

namespace quadmap
{
namespace
{
/** Cuts an ending off; false when the name does not have it. */
bool cut(std::string& name, const std::string& ending)
{
  const bool has = name.size() > ending.size() &&
                   name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
  if (has) name.resize(name.size() - ending.size());
  return has;
}
}  // namespace

std::string objectsFileOf(const std::string& rawlog)
{
  std::string name = rawlog;
  const bool gz = cut(name, ".gz");
  cut(name, ".rawlog");
  return name + ".objects.rawlog" + (gz ? ".gz" : "");
}

std::string imagesFolderOf(const std::string& rawlog)
{
  std::string name = rawlog;
  cut(name, ".gz");
  cut(name, ".rawlog");
  return name + "_Images";
}

}  // namespace quadmap
