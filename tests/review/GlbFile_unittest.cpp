#include "quadmap/review/GlbFile.h"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "../obs/TemporaryFolder.h"
#include "SampleScene.h"

using namespace quadmap;
using nlohmann::json;

namespace
{
/** A .glb taken apart by the rules of the glTF 2.0 specification, chapters 3.6 and 4. */
struct Glb
{
  json scene;
  std::string binary;

  explicit Glb(const std::string& file)
  {
    EXPECT_EQ(file.substr(0, 4), "glTF");
    EXPECT_EQ(number(file, 4), 2u) << "version";
    EXPECT_EQ(number(file, 8), file.size());
    const std::uint32_t jsonBytes = number(file, 12);
    EXPECT_EQ(jsonBytes % 4, 0u);
    EXPECT_EQ(file.substr(16, 4), "JSON") << "the first chunk";
    const std::string text = file.substr(20, jsonBytes);
    EXPECT_EQ(text.front(), '{');
    scene = json::parse(text);
    const std::size_t next = 20 + jsonBytes;
    if (next == file.size()) return;
    EXPECT_EQ(number(file, next) % 4, 0u);
    EXPECT_EQ(file.substr(next + 4, 4), std::string("BIN\0", 4));
    EXPECT_EQ(next + 8 + number(file, next), file.size()) << "nothing follows";
    binary = file.substr(next + 8);
  }

  static std::uint32_t number(const std::string& bytes, std::size_t at)
  {
    std::uint32_t value = 0;
    std::memcpy(&value, &bytes.at(at), sizeof(value));
    return value;
  }

  template <typename T>
  std::vector<T> values(std::size_t accessor) const
  {
    const json& a = scene.at("accessors").at(accessor);
    const json& view = scene.at("bufferViews").at(a.at("bufferView").get<std::size_t>());
    const std::map<std::string, std::size_t> components = {
        {"SCALAR", 1},
        {  "VEC3", 3},
        {  "VEC4", 4}
    };
    std::vector<T> out(a.at("count").get<std::size_t>() * components.at(a.at("type")));
    EXPECT_EQ(out.size() * sizeof(T), view.at("byteLength").get<std::size_t>());
    std::memcpy(
        out.data(), &binary.at(view.at("byteOffset").get<std::size_t>()), out.size() * sizeof(T));
    return out;
  }
};

void checkBuffers(const Glb& glb)
{
  ASSERT_EQ(glb.scene.at("buffers").size(), 1u);
  const auto bytes = glb.scene["buffers"][0].at("byteLength").get<std::size_t>();
  EXPECT_FALSE(glb.scene["buffers"][0].contains("uri")) << "it is the binary chunk";
  EXPECT_LE(bytes, glb.binary.size());
  EXPECT_LT(glb.binary.size(), bytes + 4);
  for (const json& view : glb.scene.at("bufferViews"))
  {
    EXPECT_EQ(view.at("byteOffset").get<std::size_t>() % 4, 0u) << "aligned for any component";
    EXPECT_GE(view.at("byteLength").get<std::size_t>(), 1u);
    EXPECT_LE(
        view.at("byteOffset").get<std::size_t>() + view.at("byteLength").get<std::size_t>(), bytes);
  }
}

void checkPositions(const Glb& glb, std::size_t accessor)
{
  const json& a = glb.scene["accessors"][accessor];
  EXPECT_EQ(a.at("componentType"), 5126);
  EXPECT_EQ(a.at("type"), "VEC3");
  const auto values = glb.values<float>(accessor);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    float low = values[axis], high = low;
    for (std::size_t i = axis; i < values.size(); i += 3)
    {
      low = std::min(low, values[i]);
      high = std::max(high, values[i]);
    }
    EXPECT_EQ(a.at("min").at(axis).get<float>(), low) << "exactly";
    EXPECT_EQ(a.at("max").at(axis).get<float>(), high);
  }
}

void checkPrimitive(const Glb& glb, const json& primitive)
{
  const json& attributes = primitive.at("attributes");
  const auto positions = attributes.at("POSITION").get<std::size_t>();
  checkPositions(glb, positions);
  const auto count = glb.scene["accessors"][positions].at("count").get<std::size_t>();
  for (const auto& [name, accessor] : attributes.items())
    EXPECT_EQ(glb.scene["accessors"][accessor.get<std::size_t>()].at("count"), count) << name;
  if (attributes.contains("NORMAL"))
  {
    const auto normals = glb.values<float>(attributes["NORMAL"].get<std::size_t>());
    for (std::size_t i = 0; i < normals.size(); i += 3)
      ASSERT_NEAR(std::hypot(normals[i], normals[i + 1], normals[i + 2]), 1.0, 5e-4);
  }
  if (primitive.contains("material"))
  {
    EXPECT_LT(primitive["material"].get<std::size_t>(), glb.scene.at("materials").size());
  }
  if (!primitive.contains("indices")) return;
  const auto accessor = primitive["indices"].get<std::size_t>();
  EXPECT_EQ(glb.scene["accessors"][accessor].at("componentType"), 5125);
  for (const std::uint32_t index : glb.values<std::uint32_t>(accessor)) ASSERT_LT(index, count);
}

/** Each node but the root has one parent, and names tell them apart. */
void checkNodes(const Glb& glb)
{
  const json& nodes = glb.scene.at("nodes");
  std::vector<int> parents(nodes.size(), 0);
  std::set<std::string> names;
  for (const json& node : nodes)
  {
    EXPECT_TRUE(names.insert(node.at("name").get<std::string>()).second) << node["name"];
    if (node.contains("mesh"))
    {
      EXPECT_LT(node["mesh"].get<std::size_t>(), glb.scene.at("meshes").size());
    }
    if (node.contains("children"))
    {
      EXPECT_FALSE(node["children"].empty());
      for (const json& child : node["children"]) ++parents.at(child.get<std::size_t>());
    }
    if (!node.contains("rotation")) continue;
    const auto q = node["rotation"].get<std::vector<double>>();
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1.0, 1e-6);
  }
  EXPECT_EQ(parents[0], 0) << "the root";
  for (std::size_t i = 1; i < parents.size(); ++i) EXPECT_EQ(parents[i], 1) << nodes[i]["name"];
  EXPECT_EQ(glb.scene.at("scenes").at(0).at("nodes"), json::array({0}));
}

Eigen::Matrix4d matrixOf(const json& node)
{
  const auto vector = [&](const char* key, double neutral)
  {
    const auto v = node.value(key, std::vector<double>(3, neutral));
    return Eigen::Vector3d(v[0], v[1], v[2]);
  };
  const auto q = node.value("rotation", std::vector<double>{0, 0, 0, 1});
  Eigen::Affine3d T = Eigen::Translation3d(vector("translation", 0)) *
                      Eigen::Quaterniond(q[3], q[0], q[1], q[2]) *
                      Eigen::Scaling(vector("scale", 1));
  return T.matrix();
}

SceneContent content()
{
  SceneContent content = quadmap::testing::sampleContent();
  content.cloud.resize(7);  // not a multiple of four
  for (std::size_t i = 0; i < 7; ++i)
  {
    content.cloud[i].position = Eigen::Vector3f(static_cast<float>(i), -2, 0.1F);
    content.cloud[i].rgb = {10, 20, 250};
  }
  return content;
}
}  // namespace

TEST(GlbFile, KeepsTheRulesOfTheSpecification)
{
  const TemporaryFolder folder;
  writeGlb(content(), folder.path("map.glb"));
  const Glb glb(readFile(folder.path("map.glb")));
  EXPECT_EQ(glb.scene.at("asset").at("version"), "2.0");
  checkBuffers(glb);
  checkNodes(glb);
  for (const json& mesh : glb.scene.at("meshes"))
    for (const json& primitive : mesh.at("primitives")) checkPrimitive(glb, primitive);
}

TEST(GlbFile, NamesObjectsByIdAndPlacesThemYUp)
{
  const TemporaryFolder folder;
  writeGlb(content(), folder.path("map.glb"));
  const json scene = Glb(readFile(folder.path("map.glb"))).scene;
  const json& nodes = scene.at("nodes");
  for (const ObjectRecord& record : content().objects)
  {
    const auto node = std::find_if(
        nodes.begin(), nodes.end(), [&](const json& n) { return n.at("name") == record.id; });
    ASSERT_NE(node, nodes.end()) << record.id;
    EXPECT_EQ(node->at("extras").at("label"), record.label);
    const Eigen::Matrix4d T = matrixOf(nodes[0]) * matrixOf(*node);
    const Eigen::Vector3d top = (T * Eigen::Vector4d(0, 0, 1, 1)).head<3>();
    const Eigen::Vector3d c = record.object.center();
    EXPECT_NEAR(top.x(), c.x(), 1e-9);
    EXPECT_NEAR(top.y(), c.z() + record.object.semiAxes().z(), 1e-9) << "y is up";
    EXPECT_NEAR(top.z(), -c.y(), 1e-9);
  }
}

TEST(GlbFile, MayBeEmpty)
{
  const TemporaryFolder folder;
  writeGlb({}, folder.path("map.glb"));
  const Glb glb(readFile(folder.path("map.glb")));
  EXPECT_TRUE(glb.binary.empty());
  for (const auto& [key, value] : glb.scene.items())
    EXPECT_FALSE(value.is_array() && value.empty()) << key << ": empty lists are not allowed";
  EXPECT_FALSE(glb.scene["nodes"][0].contains("children"));
}
