#include "quadmap/obs/BoxObjects.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "quadmap/base/Json.h"

namespace quadmap
{
namespace
{
constexpr double kPerSecond = 1e6;  // the report has times to the microsecond

std::optional<unsigned> idIn(const Json& box)
{
  const Json& object = box.at("object");
  if (object.is_null()) return std::nullopt;
  const auto id = wholeNumber(object);
  if (!id || *id < 0 || *id > std::numeric_limits<unsigned>::max())
    throw std::out_of_range("no id of an object");
  return static_cast<unsigned>(*id);
}

}  // namespace

BoxObjects::BoxObjects(const std::string& report)
{
  if (!std::filesystem::exists(report)) return;
  const Json json = readJson(report);
  try
  {
    for (const Json& keyframe : json.at("associations"))
    {
      std::vector<std::optional<unsigned>> ids;
      for (const Json& box : keyframe.at("boxes")) ids.push_back(idIn(box));
      const auto time = std::llround(keyframe.at("time").get<double>() * kPerSecond);
      byKeyframe_[{keyframe.at("sensor").get<std::string>(), time}] = std::move(ids);
    }
  }
  catch (const std::exception&)  // its text is about the inside of the library
  {
    throw std::runtime_error(report + ": its \"associations\" are not those of quadmap-slam");
  }
}

std::vector<std::optional<unsigned>> BoxObjects::of(const std::string& sensor, double time) const
{
  const long long asked = std::llround(time * kPerSecond);
  for (const long long rounded : {asked, asked - 1, asked + 1})
    if (const auto found = byKeyframe_.find({sensor, rounded}); found != byKeyframe_.end())
      return found->second;
  return {};
}

}  // namespace quadmap
