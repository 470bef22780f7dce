#pragma once

#include <mrpt/img/TColor.h>
#include <mrpt/opengl/CSetOfTriangles.h>

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "quadmap/geometry/Ellipsoid.h"

namespace quadmap
{
/** Thick lines and faces of one colour for a scene. OpenGL's own lines are only one pixel wide on
 * most machines. */
class FlatMesh
{
 public:
  /** When the mesh is drawn. MRPT draws shaded triangles from the farthest to the nearest, and then
   * those without shading. */
  enum class Order
  {
    BehindBodies,  //!< Before translucent bodies, which hide what is drawn after them
    OnTop          //!< After everything else
  };

  FlatMesh(
      const std::string& name, const mrpt::img::TColor& color, Order order = Order::BehindBodies);

  void addTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

  /** Adds a straight line, or nothing when it has no length. \param radius Half its width [m]. */
  void addLine(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);

  void addPolyline(const std::vector<Eigen::Vector3d>& points, double radius);

  /** Adds the twelve edges of the cuboid around an object. */
  void addEdges(const Ellipsoid& object, double radius);

  const mrpt::opengl::CSetOfTriangles::Ptr& mesh() const { return mesh_; }

 private:
  mrpt::opengl::CSetOfTriangles::Ptr mesh_;
};

}  // namespace quadmap
