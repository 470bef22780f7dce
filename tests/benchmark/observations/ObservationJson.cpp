#include "ObservationJson.h"

#include <nlohmann/json.hpp>

#include "quadmap/base/OutputFile.h"

namespace quadmap::observations
{
void writeRows(const std::string& path, const Rows& rows)
{
  nlohmann::ordered_json json;
  json["format"] = "quadmap-observation";
  json["version"] = 1;
  json["rows"] = nlohmann::ordered_json::object();
  for (const auto& [name, numbers] : rows) json["rows"][name] = numbers;
  writeTextFile(path, json.dump(1) + "\n");
}

}  // namespace quadmap::observations
