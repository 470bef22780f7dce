#pragma once

#include <mrpt/img/TColor.h>

#include <Eigen/Dense>
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "quadmap/base/Json.h"
#include "quadmap/review/ColouredCloud.h"

namespace quadmap
{
/** How the vertices of a primitive are joined: numbers of the glTF 2.0 specification. */
enum class GlbMode
{
  Points = 0,
  Lines = 1,
  LineStrip = 3,
  Triangles = 4
};

/** The two halves of a .glb file, JSON and binary, while they grow. Indices are those of glTF's
 * lists. The first node, "map", turns the z-up map into glTF's y-up; all others are below it. */
class GlbBody
{
 public:
  GlbBody();

  /** Accessors of vertices, with the bounds that positions need. */
  std::size_t addPositions(const std::vector<Eigen::Vector3f>& points);
  std::size_t addColors(const Cloud& cloud);
  std::size_t addIndices(const std::vector<std::uint32_t>& indices);

  std::size_t addMaterial(const std::string& name, const mrpt::img::TColor& color, double alpha);

  /** A mesh of one primitive. \param primitive Its attributes, and indices and material if any. */
  std::size_t addMesh(const std::string& name, GlbMode mode, Json primitive);

  /** A node of the map with a mesh. \param pose Translation, rotation, scale, extras, as there are.
   */
  std::size_t addNode(const std::string& name, std::size_t mesh, Json pose = Json::object());

  /** The node's child of the same pose and size. */
  void addChild(std::size_t parent, const std::string& name, std::size_t mesh);

  std::string text();  //!< The whole file

 private:
  std::size_t add(const char* list, Json item);
  std::size_t addAccessor(
      const std::string& bytes, int target, int component, const char* type, std::size_t count);

  Json json_;
  std::string binary_;
};

}  // namespace quadmap
