#include "quadmap/review/GlbFile.h"

#include <cmath>
#include <map>

#include "GlbBody.h"
#include "quadmap/base/OutputFile.h"
#include "quadmap/obs/LabelColor.h"

namespace quadmap
{
namespace
{
/** A body of radius 1, and the edges of the cube around it: accessors. */
struct UnitShapes
{
  std::size_t positions = 0, triangles = 0;  //!< Positions are the normals, too
  std::size_t corners = 0, edges = 0;
};

UnitShapes unitShapes(GlbBody& body)
{
  constexpr std::uint32_t kMeridians = 32, kParallels = 16;
  std::vector<Eigen::Vector3f> sphere, cube;
  std::vector<std::uint32_t> triangles, edges;
  for (std::uint32_t i = 0; i <= kParallels; ++i)
    for (std::uint32_t j = 0; j <= kMeridians; ++j)
    {
      const double latitude = M_PI * (static_cast<double>(i) / kParallels - 0.5);
      const double longitude = 2 * M_PI * j / kMeridians;
      const Eigen::Vector3d direction(
          std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
          std::sin(latitude));
      sphere.push_back(direction.cast<float>());
      if (i == kParallels || j == kMeridians) continue;
      const std::uint32_t low = i * (kMeridians + 1) + j, high = low + kMeridians + 1;
      triangles.insert(triangles.end(), {low, low + 1, high + 1, low, high + 1, high});
    }
  for (std::uint32_t i = 0; i < 8; ++i)
  {
    cube.emplace_back(i & 1 ? 1.F : -1.F, i & 2 ? 1.F : -1.F, i & 4 ? 1.F : -1.F);
    for (const std::uint32_t bit : {1u, 2u, 4u})
      if ((i & bit) == 0) edges.insert(edges.end(), {i, i | bit});
  }
  return {
      body.addPositions(sphere), body.addIndices(triangles), body.addPositions(cube),
      body.addIndices(edges)};
}

/** The meshes of a label, in its colour. */
struct LabelMeshes
{
  std::size_t ellipsoid = 0, cuboid = 0;
};

LabelMeshes labelMeshes(const std::string& label, const UnitShapes& shapes, GlbBody& body)
{
  constexpr double kBodyAlpha = 0.5;
  const mrpt::img::TColor color = labelColor(label);
  Json faces, lines;
  faces["attributes"]["POSITION"] = faces["attributes"]["NORMAL"] = shapes.positions;
  faces["indices"] = shapes.triangles;
  faces["material"] = body.addMaterial(label + " body", color, kBodyAlpha);
  lines["attributes"]["POSITION"] = shapes.corners;
  lines["indices"] = shapes.edges;
  lines["material"] = body.addMaterial(label + " edges", color, 1);
  return {
      body.addMesh(label + " ellipsoid", GlbMode::Triangles, faces),
      body.addMesh(label + " cuboid", GlbMode::Lines, lines)};
}

Json poseJson(const ObjectRecord& record)
{
  const Eigen::Vector3d c = record.object.center(), s = record.object.semiAxes();
  const Eigen::Quaterniond q(record.object.rotation());
  Json json;
  json["translation"] = {c.x(), c.y(), c.z()};
  json["rotation"] = {q.x(), q.y(), q.z(), q.w()};
  json["scale"] = {s.x(), s.y(), s.z()};
  json["extras"]["label"] = record.label;
  return json;
}

void addObjects(const std::vector<ObjectRecord>& objects, GlbBody& body)
{
  if (objects.empty()) return;
  const UnitShapes shapes = unitShapes(body);
  std::map<std::string, LabelMeshes> meshes;
  for (const ObjectRecord& record : objects)
  {
    if (meshes.count(record.label) == 0)
      meshes[record.label] = labelMeshes(record.label, shapes, body);
    const LabelMeshes& mesh = meshes[record.label];
    const std::size_t node = body.addNode(record.id, mesh.ellipsoid, poseJson(record));
    body.addChild(node, record.id + " cuboid", mesh.cuboid);
  }
}

void addLine(
    const std::vector<mrpt::poses::CPose3D>& poses,
    const std::string& name,
    const mrpt::img::TColor& color,
    GlbBody& body)
{
  if (poses.size() < 2) return;
  std::vector<Eigen::Vector3f> points;
  for (const auto& p : poses) points.push_back(Eigen::Vector3d(p.x(), p.y(), p.z()).cast<float>());
  Json line;
  line["attributes"]["POSITION"] = body.addPositions(points);
  line["material"] = body.addMaterial(name, color, 1);
  body.addNode(name, body.addMesh(name, GlbMode::LineStrip, line));
}

void addCloud(const Cloud& cloud, GlbBody& body)
{
  if (cloud.empty()) return;
  std::vector<Eigen::Vector3f> positions;
  for (const CloudPoint& p : cloud) positions.push_back(p.position);
  Json points;
  points["attributes"]["POSITION"] = body.addPositions(positions);
  points["attributes"]["COLOR_0"] = body.addColors(cloud);
  body.addNode("cloud", body.addMesh("cloud", GlbMode::Points, points));
}

}  // namespace

void writeGlb(const SceneContent& content, const std::string& path)
{
  GlbBody body;
  addObjects(content.objects, body);
  addLine(content.trajectory, "trajectory", {20, 60, 160}, body);
  addLine(content.odometry, "odometry", {230, 120, 20}, body);
  addCloud(content.cloud, body);
  writeTextFile(path, body.text());
}

}  // namespace quadmap
