#include "quadmap/base/Json.h"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "quadmap/base/OutputSet.h"

namespace quadmap
{
Json readJson(const std::string& path)
{
  requireOneRun(path);
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read (does the file exist?)");
  try
  {
    return Json::parse(file);
  }
  catch (const Json::exception& e)
  {
    throw std::runtime_error(path + ": " + e.what());
  }
}

std::string jsonText(const Json& json, int indent)
{
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json rounded(double value, int decimals)
{
  const double scale = std::pow(10.0, decimals);
  if (!std::isfinite(value)) return nullptr;
  return std::round(value * scale) / scale + 0.0;  // no negative zero
}

Json orNull(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

}  // namespace quadmap
