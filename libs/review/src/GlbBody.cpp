#include "GlbBody.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace quadmap
{
namespace
{
// Numbers of the glTF 2.0 specification.
constexpr int kFloat = 5126, kUnsignedByte = 5121, kUnsignedInt = 5125;
constexpr int kVertices = 34962, kIndices = 34963;  // targets of buffer views
constexpr std::size_t kAlignment = 4;
constexpr std::size_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

/** Little endian, four bytes each. */
std::string numbers(std::initializer_list<std::size_t> values)
{
  std::string bytes;
  for (const std::size_t value : values)
  {
    if (value > std::numeric_limits<std::uint32_t>::max())
      throw std::runtime_error("the scene is too large for a .glb file");
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((value >> shift) & 0xFF);
  }
  return bytes;
}

void pad(std::string& bytes, char filler)
{
  bytes.append((kAlignment - bytes.size() % kAlignment) % kAlignment, filler);
}

Json floatsJson(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

/** glTF wants colours in proportion to light; ours are as screens have them (about gamma 2.2). */
Json linearColor(const mrpt::img::TColor& color, double alpha)
{
  Json json = Json::array();
  for (const std::uint8_t channel : {color.R, color.G, color.B})
    json.push_back(rounded(std::pow(channel / 255.0, 2.2), 4));
  json.push_back(alpha);
  return json;
}

}  // namespace

GlbBody::GlbBody()
{
  json_["asset"] = {
      {  "version",     "2.0"},
      {"generator", "quadmap"}
  };
  json_["scene"] = 0;
  for (const char* list : {"scenes", "nodes", "meshes", "materials", "accessors", "bufferViews"})
    json_[list] = Json::array();
  json_["scenes"][0]["nodes"] = Json::array({0});
  Json map;
  map["name"] = "map";
  const double half = std::sqrt(0.5);  // a quarter turn: (x, y, z) becomes (x, z, -y)
  map["rotation"] = Json::array({-half, 0.0, 0.0, half});
  map["children"] = Json::array();
  json_["nodes"].push_back(map);
}

std::size_t GlbBody::add(const char* list, Json item)
{
  json_[list].push_back(std::move(item));
  return json_[list].size() - 1;
}

std::size_t GlbBody::addAccessor(
    const std::string& bytes, int target, int component, const char* type, std::size_t count)
{
  Json view;
  view["buffer"] = 0;
  view["byteOffset"] = binary_.size();
  view["byteLength"] = bytes.size();
  view["target"] = target;
  binary_ += bytes;
  pad(binary_, '\0');
  Json accessor;
  accessor["bufferView"] = add("bufferViews", std::move(view));
  accessor["componentType"] = component;
  accessor["type"] = type;
  accessor["count"] = count;
  return add("accessors", std::move(accessor));
}

std::size_t GlbBody::addPositions(const std::vector<Eigen::Vector3f>& points)
{
  Eigen::AlignedBox3f box;
  std::string bytes(points.size() * 3 * sizeof(float), '\0');
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    box.extend(points[i]);
    std::memcpy(&bytes[i * 3 * sizeof(float)], points[i].data(), 3 * sizeof(float));
  }
  const std::size_t index = addAccessor(bytes, kVertices, kFloat, "VEC3", points.size());
  json_["accessors"][index]["min"] = floatsJson(box.min());
  json_["accessors"][index]["max"] = floatsJson(box.max());
  return index;
}

std::size_t GlbBody::addColors(const Cloud& cloud)
{
  std::string bytes;  // with a fourth byte each, because vertices are aligned
  for (const CloudPoint& p : cloud)
  {
    for (const std::uint8_t channel : p.rgb) bytes += static_cast<char>(channel);
    bytes += '\xFF';
  }
  const std::size_t index = addAccessor(bytes, kVertices, kUnsignedByte, "VEC4", cloud.size());
  json_["accessors"][index]["normalized"] = true;
  return index;
}

std::size_t GlbBody::addIndices(const std::vector<std::uint32_t>& indices)
{
  std::string bytes(indices.size() * sizeof(std::uint32_t), '\0');
  std::memcpy(bytes.data(), indices.data(), bytes.size());
  return addAccessor(bytes, kIndices, kUnsignedInt, "SCALAR", indices.size());
}

std::size_t GlbBody::addMaterial(
    const std::string& name, const mrpt::img::TColor& color, double alpha)
{
  Json material;
  material["name"] = name;
  material["alphaMode"] = alpha < 1 ? "BLEND" : "OPAQUE";
  Json& surface = material["pbrMetallicRoughness"];
  surface["baseColorFactor"] = linearColor(color, alpha);
  surface["metallicFactor"] = 0;
  return add("materials", std::move(material));
}

std::size_t GlbBody::addMesh(const std::string& name, GlbMode mode, Json primitive)
{
  primitive["mode"] = static_cast<int>(mode);
  Json mesh;
  mesh["name"] = name;
  mesh["primitives"] = Json::array({std::move(primitive)});
  return add("meshes", std::move(mesh));
}

std::size_t GlbBody::addNode(const std::string& name, std::size_t mesh, Json pose)
{
  pose["name"] = name;
  pose["mesh"] = mesh;
  const std::size_t index = add("nodes", std::move(pose));
  json_["nodes"][0]["children"].push_back(index);
  return index;
}

void GlbBody::addChild(std::size_t parent, const std::string& name, std::size_t mesh)
{
  Json node;
  node["name"] = name;
  node["mesh"] = mesh;
  json_["nodes"][parent]["children"] = Json::array({add("nodes", std::move(node))});
}

std::string GlbBody::text()
{
  Json file = json_;  // in which empty lists are not allowed
  for (const char* list : {"meshes", "materials", "accessors", "bufferViews"})
    if (file[list].empty()) file.erase(list);
  if (file["nodes"][0]["children"].empty()) file["nodes"][0].erase("children");
  if (!binary_.empty()) file["buffers"][0]["byteLength"] = binary_.size();

  std::string json = jsonText(file);
  pad(json, ' ');
  std::string chunks = numbers({json.size(), kJsonChunk}) + json;
  if (!binary_.empty()) chunks += numbers({binary_.size(), kBinaryChunk}) + binary_;
  constexpr std::size_t kHead = 12;
  return numbers({kMagic, 2, kHead + chunks.size()}) + chunks;
}

}  // namespace quadmap
