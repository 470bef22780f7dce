#include "quadmap/relations/AnswerFile.h"

#include <nlohmann/json.hpp>

#include "quadmap/base/Json.h"

namespace quadmap
{
namespace
{
/** The object as objects.json has it. */
Json recordJson(const ObjectRecord& record)
{
  return Json::parse(objectsToJson({record})).at("objects").at(0);
}

Json idJson(const std::string& id)
{
  ObjectRecord record;  // ids are numbers there where they are numbers in objects.json
  record.id = id;
  return recordJson(record).at("id");
}

Json reasonJson(const Reason& reason)
{
  constexpr int kDecimals = 4;
  Json json;
  json["relation"] = textOf(reason.kind);
  json["to"] = Json::array();
  for (const std::string& id : reason.objects) json["to"].push_back(idJson(id));
  json["distance_m"] = rounded(reason.distance, kDecimals);
  json["text"] = reason.text;
  return json;
}

Json foundJson(const FoundObject& found)
{
  Json json = recordJson(found.item.record);
  json["doubtful"] = found.item.isDoubtful();
  json["reasons"] = Json::array();
  for (const Reason& reason : found.reasons) json["reasons"].push_back(reasonJson(reason));
  return json;
}

}  // namespace

std::string answerToJson(const Answer& answer, const std::string& question)
{
  std::string text = objectsToJson({});  // what the file is, and no objects
  text.resize(text.find("\"objects\""));
  text += "\"question\":" + jsonText(Json(question)) + ",\n\"objects\":[";
  const char* separator = "\n ";
  for (const FoundObject& found : answer.found)
  {
    text += separator + jsonText(foundJson(found));
    separator = ",\n ";
  }
  return text + "\n]}\n";
}

}  // namespace quadmap
