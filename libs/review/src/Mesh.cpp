#include "Mesh.h"

#include <array>
#include <cmath>

namespace quadmap
{
namespace
{
const mrpt::math::TPoint3Df kTowardsLight(0.40825F, 0.40825F, 0.8165F);  // MRPT's default light
}

FlatMesh::FlatMesh(const std::string& name, const mrpt::img::TColor& color, Order order) :
    mesh_(mrpt::opengl::CSetOfTriangles::Create())
{
  mesh_->setName(name);
  mesh_->setColor_u8(color);
  mesh_->enableLight(order == Order::BehindBodies);
  constexpr float kFarBelow = -1e4F;  // farther than any body, seen from above [m]
  if (order == Order::BehindBodies) mesh_->setLocalRepresentativePoint({0, 0, kFarBelow});
}

void FlatMesh::addTriangle(
    const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  const auto vertex = [](const Eigen::Vector3d& p)
  {
    return mrpt::math::TPoint3Df(
        static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
  };
  mrpt::opengl::TTriangle triangle(vertex(a), vertex(b), vertex(c));
  triangle.setColor(mesh_->getColor_u8());
  for (auto& corner : triangle.vertices)
    corner.normal = kTowardsLight;  // gives all faces the same brightness
  mesh_->insertTriangle(triangle);
}

void FlatMesh::addLine(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius)
{
  constexpr int kSides = 6;
  constexpr double kShortest = 1e-6;  // length below which there is no line [m]
  if ((to - from).norm() < kShortest) return;
  const Eigen::Vector3d along = (to - from).normalized();
  const Eigen::Vector3d u = along.unitOrthogonal(), v = along.cross(u);
  const auto spoke = [&](int i) -> Eigen::Vector3d
  {
    const double angle = 2 * M_PI * i / kSides;
    return radius * (std::cos(angle) * u + std::sin(angle) * v);
  };
  // The line is a little longer than asked for, so that lines meet in corners.
  const Eigen::Vector3d a = from - 0.8 * radius * along, b = to + 0.8 * radius * along;
  for (int i = 0; i < kSides; ++i)
  {
    addTriangle(a + spoke(i), b + spoke(i), b + spoke(i + 1));
    addTriangle(a + spoke(i), b + spoke(i + 1), a + spoke(i + 1));
    addTriangle(a, a + spoke(i + 1), a + spoke(i));
    addTriangle(b, b + spoke(i), b + spoke(i + 1));
  }
}

void FlatMesh::addPolyline(const std::vector<Eigen::Vector3d>& points, double radius)
{
  for (std::size_t i = 1; i < points.size(); ++i) addLine(points[i - 1], points[i], radius);
}

void FlatMesh::addEdges(const Ellipsoid& object, double radius)
{
  const Eigen::Matrix<double, 3, 8> corners = object.cuboidCorners();
  for (const int bit : {1, 2, 4})
    for (int i = 0; i < 8; ++i)
      if ((i & bit) == 0) addLine(corners.col(i), corners.col(i | bit), radius);
}

}  // namespace quadmap
