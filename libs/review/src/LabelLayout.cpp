#include "LabelLayout.h"

#include <mrpt/opengl/CText3D.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "LabelColor.h"
#include "Mesh.h"
#include "quadmap/geometry/ImageBox.h"

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
  const double width = textWidth(record.label) * height;
  const double x = 0.5 * width + 0.35 * height, y = 0.75 * height;
  FlatMesh background("plate", mrpt::img::TColor(255, 255, 255, 215), FlatMesh::Order::OnTop);
  background.addTriangle({-x, -y, 0}, {x, -y, 0}, {x, y, 0});
  background.addTriangle({-x, -y, 0}, {x, y, 0}, {-x, y, 0});

  auto text = mrpt::opengl::CText3D::Create(
      record.label, "sans", static_cast<float>(height), mrpt::opengl::FILL, kLineSpacing, kKerning);
  text->setColor_u8(labelColor(record.label));
  text->setLocation(-0.5 * width, -0.45 * height, 0.05 * height);

  auto group = CSetOfObjects::Create();
  group->setPose(facing(camera, p));
  group->setName(record.label + " " + record.id);
  group->insert(background.mesh());
  group->insert(text);
  return group;
}

/** The point above an object's centre at the height of its highest corner. */
Eigen::Vector3d topOf(const ObjectRecord& record)
{
  Eigen::Vector3d top = record.object.center();
  top.z() = record.object.cuboidCorners().row(2).maxCoeff();
  return top;
}

/** A label and its place in the picture. The unit of length is the height of the picture, the
 * origin its middle, and y points up. */
struct Placed
{
  const ObjectRecord* record;
  Eigen::Vector2d anchor;  // top of the object
  ImageBox box;

  void moveTo(double x, double y)
  {
    const double w = box.width(), h = box.height();
    box = {x - 0.5 * w, y - 0.5 * h, x + 0.5 * w, y + 0.5 * h};
  }
};

std::optional<Eigen::Vector2d> inPicture(const RenderCamera& camera, const Eigen::Vector3d& p_map)
{
  const Eigen::Vector3d p = camera.axes().transpose() * (p_map - camera.eye());
  if (p.z() >= 0) return std::nullopt;
  return Eigen::Vector2d(p.head<2>() / (-p.z() * 2 * std::tan(0.5 * camera.verticalFov)));
}

/** Finds a place that no other label takes: above the object, or else higher or lower. */
void findFreePlace(Placed& label, const std::vector<Placed>& others, double aspect)
{
  const double h = label.box.height(), w = label.box.width();
  const double x = std::clamp(label.anchor.x(), -0.5 * aspect + 0.5 * w, 0.5 * aspect - 0.5 * w);
  constexpr int kPlaces = 24;
  for (int i = 0; i < kPlaces; ++i)
  {
    const int step = (i + 1) / 2 * (i % 2 == 1 ? 1 : -1);
    const double y = label.anchor.y() + (0.75 + 0.6 * step) * h;
    label.moveTo(x, std::clamp(y, -0.5 + 0.5 * h, 0.5 - 0.5 * h));
    const bool isFree = std::none_of(
        others.begin(), others.end(),
        [&](const Placed& other) { return imageBoxIoU(label.box, other.box) > 0; });
    if (isFree) return;
  }
  label.moveTo(x, label.anchor.y() + 0.75 * h);
}

}  // namespace

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

CSetOfObjects::Ptr pictureLabels(
    const std::vector<ObjectRecord>& objects,
    const RenderCamera& camera,
    const PictureLabels& style)
{
  std::vector<Placed> placed;
  for (const ObjectRecord& record : objects)
  {
    const auto anchor = inPicture(camera, topOf(record));
    if (!anchor) continue;
    const double width = (textWidth(record.label) + 0.7) * style.height;
    Placed label{
        &record, *anchor, ImageBox{0, 0, width, 1.5 * style.height}
    };
    findFreePlace(label, placed, style.aspect);
    placed.push_back(label);
  }

  // The labels are drawn on a plane near the eye, so that nothing hides them.
  const double nearDistance = 0.05 * camera.distance;
  const double metresPerHeight = 2 * std::tan(0.5 * camera.verticalFov) * nearDistance;
  const auto onPlane = [&](double x, double y) -> Eigen::Vector3d
  {
    return camera.eye() +
           camera.axes() * Eigen::Vector3d(x * metresPerHeight, y * metresPerHeight, -nearDistance);
  };
  auto group = CSetOfObjects::Create();
  group->setName("labels");
  for (const Placed& label : placed)
  {
    const Eigen::Vector3d p = onPlane(label.box.centerX(), label.box.centerY());
    group->insert(plate(*label.record, camera, p, style.height * metresPerHeight));
  }
  return group;
}

}  // namespace quadmap
