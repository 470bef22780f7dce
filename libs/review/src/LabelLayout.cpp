#include "LabelLayout.h"

#include <mrpt/opengl/CText3D.h>

#include <algorithm>

#include "Mesh.h"
#include "quadmap/obs/LabelColor.h"

namespace quadmap
{
namespace
{
using mrpt::opengl::CSetOfObjects;

constexpr double kLineSpacing = 1.5, kKerning = 0.06;  // / height of a letter

/** Pose of a thing that faces the eye: x right, y up, z towards the eye. */
mrpt::poses::CPose3D facing(const RenderCamera& camera, const Eigen::Vector3d& p)
{
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  T.topLeftCorner<3, 3>() = camera.axes();
  T.topRightCorner<3, 1>() = p;
  return mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(T));
}

/** A text that knows its true width. CText3D's bounding box only counts letters. */
struct MeasuredText : public mrpt::opengl::CText3D
{
  explicit MeasuredText(const std::string& text) :
      CText3D(text, "sans", 1.0F, mrpt::opengl::FILL, kLineSpacing, kKerning)
  {
    onUpdateBuffers_Text();
  }
  double width() const
  {
    float right = 0;
    for (const auto& triangle : m_triangles)
      for (const auto& vertex : triangle.vertices) right = std::max(right, vertex.xyzrgba.pt.x);
    return static_cast<double>(right);
  }
};

/** Width of a text / height of its letters. */
double textWidth(const std::string& text) { return MeasuredText(text).width(); }

/** A white plate with a text on it. Its centre is `p`, and its letters are `height` high [m]. */
CSetOfObjects::Ptr plate(
    const ObjectRecord& record, const RenderCamera& camera, const Eigen::Vector3d& p, double height)
{
  const std::string name = record.label + " " + record.id;
  const double width = textWidth(name) * height;
  const double x = 0.5 * width + 0.35 * height, y = 0.75 * height;
  FlatMesh background("plate", mrpt::img::TColor(255, 255, 255, 215), FlatMesh::Order::OnTop);
  background.addTriangle({-x, -y, 0}, {x, -y, 0}, {x, y, 0});
  background.addTriangle({-x, -y, 0}, {x, y, 0}, {-x, y, 0});

  auto text = mrpt::opengl::CText3D::Create(
      name, "sans", static_cast<float>(height), mrpt::opengl::FILL, kLineSpacing, kKerning);
  text->setColor_u8(labelColor(record.label));
  text->setLocation(-0.5 * width, -0.45 * height, 0.05 * height);

  auto group = CSetOfObjects::Create();
  group->setPose(facing(camera, p));
  group->setName(name);
  group->insert(background.mesh());
  group->insert(text);
  return group;
}

}  // namespace

Eigen::Vector3d topOf(const ObjectRecord& record)
{
  Eigen::Vector3d top = record.object.center();
  top.z() = record.object.cuboidCorners().row(2).maxCoeff();
  return top;
}

CSetOfObjects::Ptr standingLabels(
    const std::vector<ObjectRecord>& objects, const RenderCamera& camera, double height)
{
  auto group = CSetOfObjects::Create();
  group->setName("labels");
  for (const ObjectRecord& record : objects)
    group->insert(
        plate(record, camera, topOf(record) + Eigen::Vector3d(0, 0, 1.2 * height), height));
  return group;
}

}  // namespace quadmap
