#include "quadmap/review/PlyFile.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "../obs/TemporaryFolder.h"
#include "SampleScene.h"

using namespace quadmap;
using namespace quadmap::testing;

namespace
{
constexpr std::size_t kVertexBytes = 19, kFaceBytes = 13;

struct PlyHeader
{
  std::size_t vertices = 0, faces = 0, bytes = 0;
};

PlyHeader headerOf(const std::string& text)
{
  PlyHeader header;
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line) && line != "end_header")
  {
    std::istringstream words(line);
    std::string element, name;
    std::size_t count = 0;
    if (words >> element >> name >> count && element == "element")
      (name == "vertex" ? header.vertices : header.faces) = count;
  }
  header.bytes = static_cast<std::size_t>(lines.tellg());
  return header;
}
}  // namespace

TEST(PlyFile, HoldsTheSurfacesAndTheCloud)
{
  const TemporaryFolder folder;
  SceneContent content = sampleContent();
  content.objects.resize(1);
  content.cloud.resize(7);
  for (CloudPoint& p : content.cloud) p.position = Eigen::Vector3f(1, 2, 3);
  writePly(content, folder.path("map.ply"));

  const std::string text = readFile(folder.path("map.ply"));
  ASSERT_EQ(text.substr(0, 4), "ply\n");
  const PlyHeader header = headerOf(text);
  ASSERT_EQ(text.size(), header.bytes + header.vertices * kVertexBytes + header.faces * kFaceBytes);
  ASSERT_GT(header.faces, 500u);
  EXPECT_NE(text.find("\ncomment object 1 chair\n"), std::string::npos);

  const Ellipsoid& object = content.objects[0].object;
  for (std::size_t i = 0; i < header.vertices; ++i)
  {
    float xyz[3];
    std::memcpy(xyz, &text[header.bytes + i * kVertexBytes], sizeof(xyz));
    std::int32_t id = 0;
    std::memcpy(&id, &text[header.bytes + i * kVertexBytes + 15], sizeof(id));
    EXPECT_EQ(id, i < header.vertices - content.cloud.size() ? 1 : -1);
    const Eigen::Vector3d p(xyz[0], xyz[1], xyz[2]);
    const Eigen::Vector3d p_obj = object.rotation().transpose() * (p - object.center());
    if (i < header.vertices - content.cloud.size())
      EXPECT_NEAR(p_obj.cwiseQuotient(object.semiAxes()).norm(), 1, 1e-5) << "on the surface";
    else
      EXPECT_EQ(p, Eigen::Vector3d(1, 2, 3));
  }
  for (std::size_t i = 0; i < header.faces; ++i)
  {
    const std::size_t at = header.bytes + header.vertices * kVertexBytes + i * kFaceBytes;
    ASSERT_EQ(text[at], 3);
    std::uint32_t corners[3];
    std::memcpy(corners, &text[at + 1], sizeof(corners));
    for (const auto corner : corners) ASSERT_LT(corner, header.vertices - content.cloud.size());
  }
}

TEST(PlyFile, UnwritableIsReported)
{
  const std::string error = errorOf([] { writePly(sampleContent(), "/nonexistent/map.ply"); });
  EXPECT_NE(error.find("/nonexistent/map.ply"), std::string::npos) << error;
}
