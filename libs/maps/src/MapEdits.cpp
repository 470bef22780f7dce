#include "quadmap/maps/MapEdits.h"

#include <mrpt/core/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "quadmap/base/Json.h"
#include "quadmap/obs/Plausible.h"

namespace quadmap
{
namespace
{
/** \exception std::runtime_error If the key is missing or its value of another type. */
template <typename T>
T valueOf(const Json& edit, const char* key)
try
{
  return edit.at(key).get<T>();
}
catch (const Json::exception&)  // its text is about the inside of the library
{
  throw std::runtime_error(mrpt::format("\"%s\" is missing or of another type", key));
}

ObjectId idFrom(const Json& edit, const char* key)
{
  const auto id = wholeNumber(valueOf<Json>(edit, key));
  if (!id || *id < 0 || *id > std::numeric_limits<ObjectId>::max())
    throw std::runtime_error(mrpt::format("\"%s\" is no id of a map", key));
  return static_cast<ObjectId>(*id);
}

Eigen::Vector3d vectorFrom(const Json& edit, const char* key)
{
  const auto values = valueOf<std::vector<double>>(edit, key);
  if (values.size() != 3)
    throw std::runtime_error(mrpt::format("\"%s\" must have three numbers", key));
  return {values[0], values[1], values[2]};
}

/** Where a person put an object. */
Ellipsoid placeFrom(const Json& edit)
{
  const Eigen::Vector3d center = vectorFrom(edit, "center"), size = vectorFrom(edit, "size");
  const auto yaw = valueOf<double>(edit, "yaw");
  const auto check = [](const char* key, const std::optional<std::string>& why)
  {
    if (why) throw std::runtime_error(mrpt::format("\"%s\" %s", key, why->c_str()));
  };
  if (!(std::abs(yaw) <= kLargestAngle))
    throw std::runtime_error(mrpt::format("\"yaw\" is %g rad, which is absurd", yaw));
  const mrpt::poses::CPose3D T_map_obj(center.x(), center.y(), center.z(), yaw, 0, 0);
  check("center", whyNoPose(T_map_obj));
  check("size", whyNoSize(size));
  return Ellipsoid(T_map_obj, 0.5 * size);
}

MapEdit editFrom(const Json& json)
{
  MapEdit edit;
  const auto op = valueOf<std::string>(json, "op");
  edit.id = idFrom(json, op == "merge" ? "keep" : "id");
  if (op == "relabel")
  {
    edit.kind = MapEdit::Kind::Relabel;
    edit.label = valueOf<std::string>(json, "label");
    if (edit.label.empty()) throw std::runtime_error("\"label\" is empty");
  }
  else if (op == "merge")
  {
    edit.kind = MapEdit::Kind::Merge;
    edit.absorbed = idFrom(json, "absorb");
  }
  else if (op == "place")
  {
    edit.kind = MapEdit::Kind::Place;
    edit.object = placeFrom(json);
  }
  else if (op != "remove")
    throw std::runtime_error("\"op\" must be relabel, merge, remove or place");
  return edit;
}

void apply(const MapEdit& edit, CQuadricObjectMap& map)
{
  switch (edit.kind)
  {
    case MapEdit::Kind::Relabel:
      return map.relabel(edit.id, edit.label);
    case MapEdit::Kind::Merge:
      return map.merge(edit.id, edit.absorbed);
    case MapEdit::Kind::Remove:
      return map.remove(edit.id);
    case MapEdit::Kind::Place:
      return map.place(edit.id, edit.object);
  }
}

}  // namespace

MapEditList readMapEdits(const std::string& path)
{
  const Json json = readJson(path);
  const auto fail = [&](const std::string& what) { throw std::runtime_error(path + ": " + what); };
  if (!json.is_object() || json.value("format", Json()) != "quadmap-edits" ||
      !json.contains("edits") || !json.at("edits").is_array())
    fail("is no list of edits: expected \"format\": \"quadmap-edits\" and \"edits\"");
  if (json.value("version", Json()) != 1) fail("is of another version than 1, which is known here");
  MapEditList list;
  const Json map = json.value("map_sha256", Json(""));
  if (!map.is_string()) fail("\"map_sha256\" must be text");
  list.mapSha256 = map.get<std::string>();
  for (const Json& edit : json.at("edits")) try
    {
      list.edits.push_back(editFrom(edit));
    }
    catch (const std::exception& e)
    {
      fail(mrpt::format("edit %zu: %s", list.edits.size() + 1, e.what()));
    }
  return list;
}

void applyEdits(const std::vector<MapEdit>& edits, CQuadricObjectMap& map)
{
  CQuadricObjectMap edited = map;
  for (std::size_t i = 0; i < edits.size(); ++i) try
    {
      apply(edits[i], edited);
    }
    catch (const std::exception& e)
    {
      throw std::runtime_error(mrpt::format("edit %zu: %s", i + 1, e.what()));
    }
  map = std::move(edited);
}

}  // namespace quadmap
