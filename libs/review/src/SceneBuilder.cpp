#include "quadmap/review/SceneBuilder.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/opengl/CEllipsoid3D.h>
#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfObjects.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "LabelLayout.h"
#include "Mesh.h"
#include "SceneColors.h"
#include "quadmap/base/GzipStream.h"
#include "quadmap/obs/LabelColor.h"

namespace quadmap
{
namespace
{
using mrpt::img::TColor;
using mrpt::opengl::CSetOfObjects;
using mrpt::poses::CPose3D;

constexpr std::uint8_t kBodyAlpha = 120;
const mrpt::img::TColorf kBackground(0.985F, 0.985F, 0.98F);
const mrpt::img::TColorf kAmbientLight(0.65F, 0.65F, 0.65F);
const mrpt::img::TColorf kDiffuseLight(0.45F, 0.45F, 0.45F);
const mrpt::img::TColorf kSpecularLight(0.1F, 0.1F, 0.1F);
const TColor kGridColor(0, 0, 0, 40);

std::string nameOf(const ObjectRecord& record) { return record.label + " " + record.id; }

/** Lower and upper corner of the floor that belongs to the content. */
Eigen::AlignedBox3d boundsOf(const SceneContent& content)
{
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& p : content.extent()) bounds.extend(p);
  if (bounds.isEmpty())
    bounds = Eigen::AlignedBox3d(Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(1, 1, 1));
  return bounds;
}

mrpt::opengl::CRenderizable::Ptr floorGrid(const SceneContent& content)
{
  constexpr double kSpacing = 0.5;  // of the lines on the floor [m]
  const Eigen::AlignedBox3d bounds = boundsOf(content);
  const auto down = [&](double v)
  { return static_cast<float>(kSpacing * std::floor(v / kSpacing) - kSpacing); };
  const auto up = [&](double v)
  { return static_cast<float>(kSpacing * std::ceil(v / kSpacing) + kSpacing); };
  auto grid = mrpt::opengl::CGridPlaneXY::Create(
      down(bounds.min().x()), up(bounds.max().x()), down(bounds.min().y()), up(bounds.max().y()),
      static_cast<float>(content.floorHeight()), static_cast<float>(kSpacing));
  grid->setColor_u8(kGridColor);
  grid->setName("floor");
  return grid;
}

/** The ellipsoid as a translucent body. */
mrpt::opengl::CEllipsoid3D::Ptr bodyOf(const ObjectRecord& record)
{
  const Eigen::Vector3d s = record.object.semiAxes();
  auto body = mrpt::opengl::CEllipsoid3D::Create();
  // MRPT turns a full covariance wrongly. It is therefore diagonal, and the pose has the rotation.
  mrpt::math::CMatrixDouble33 covariance;
  covariance.setZero();
  for (int i = 0; i < 3; ++i) covariance(i, i) = s[i] * s[i];
  body->setCovMatrix(covariance);
  body->setQuantiles(1.0F);
  body->set3DsegmentsCount(40);
  body->enableDrawSolid3D(true);
  body->setColor_u8(labelColor(record.label, kBodyAlpha));
  body->setPose(record.object.pose());
  body->setName(nameOf(record));
  return body;
}

/** The ellipsoids, each with the edges of its cuboid around it. */
CSetOfObjects::Ptr objectsOf(const SceneContent& content, double lineRadius)
{
  auto group = CSetOfObjects::Create();
  group->setName("objects");
  for (const ObjectRecord& record : content.objects)
  {
    FlatMesh wires(nameOf(record) + " cuboid", labelColor(record.label));
    wires.addEdges(record.object, lineRadius);
    group->insert(bodyOf(record));
    group->insert(wires.mesh());
  }
  return group;
}

CSetOfObjects::Ptr truthOf(const SceneContent& content, double lineRadius)
{
  auto group = CSetOfObjects::Create();
  group->setName("truth");
  for (const ObjectRecord& record : content.truth)
  {
    FlatMesh wires("true " + nameOf(record), kTruthColor);
    wires.addEdges(record.object, lineRadius);
    group->insert(wires.mesh());
  }
  return group;
}

mrpt::opengl::CSetOfTriangles::Ptr lineThrough(
    const std::vector<CPose3D>& poses, FlatMesh line, double lineRadius)
{
  std::vector<Eigen::Vector3d> points;
  for (const CPose3D& pose : poses) points.emplace_back(pose.x(), pose.y(), pose.z());
  line.addPolyline(points, lineRadius);
  return line.mesh();
}

/** A pyramid with its tip in the camera's centre, which opens to where the camera looks. */
void addPyramid(const CameraPose& camera, double length, double lineRadius, FlatMesh& mesh)
{
  const double y = length * std::tan(0.5 * camera.horizontalFov);
  const double z = length * std::tan(0.5 * camera.verticalFov);
  const auto toMap = [&](double px, double py, double pz)
  {
    const mrpt::math::TPoint3D p = camera.T_map_sensor.composePoint({px, py, pz});
    return Eigen::Vector3d(p.x, p.y, p.z);
  };
  const Eigen::Vector3d tip = toMap(0, 0, 0);
  const std::array<Eigen::Vector3d, 4> corners = {
      toMap(length, y, z), toMap(length, -y, z), toMap(length, -y, -z), toMap(length, y, -z)};
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    mesh.addLine(tip, corners[i], lineRadius);
    mesh.addLine(corners[i], corners[(i + 1) % corners.size()], lineRadius);
  }
}

mrpt::opengl::CSetOfTriangles::Ptr camerasOf(
    const SceneContent& content, const SceneOptions& options, double lineRadius)
{
  FlatMesh mesh("cameras", kTrajectoryColor);
  const std::size_t count = std::min<std::size_t>(options.shownCameras, content.cameras.size());
  for (std::size_t i = 0; i < count; ++i)
    addPyramid(
        content.cameras[i * content.cameras.size() / count], options.cameraLength, lineRadius,
        mesh);
  return mesh.mesh();
}

float paleColor(std::uint8_t value, double paleness)
{
  const double v = value / 255.0;
  return static_cast<float>(v + paleness * (1.0 - v));
}

/** Whether a point is part of an object. Points slightly outside count, because depth is noisy, but
 * not those of the surface that the object stands on. */
bool isInside(const Eigen::Vector3d& p_map, const std::vector<ObjectRecord>& objects)
{
  constexpr double kNoise = 0.06;  // distance outside an object that still counts [m]
  return std::any_of(
      objects.begin(), objects.end(),
      [&](const ObjectRecord& record)
      {
        const Eigen::Vector3d s = record.object.semiAxes();
        const Eigen::Vector3d p_obj =
            record.object.rotation().transpose() * (p_map - record.object.center());
        const bool isAbove = p_obj.z() > std::min(-s.z() + kNoise, 0.0);
        return isAbove && (p_obj.cwiseAbs() - s).maxCoeff() < kNoise;
      });
}

/** Whether a surface faces the eye. At a grazing angle it does not, because normals are noisy. From
 * straight above walls are left out altogether: they would cover what stands along them. */
bool facesEye(const CloudPoint& p, const RenderCamera& camera)
{
  constexpr double kGrazing = 0.15, kLevel = 0.6;  // cosines of the angle to the normal
  constexpr double kAbove = 1.4;                   // elevation of a camera straight above [rad]
  const Eigen::Vector3d toEye = (camera.eye() - p.position.cast<double>()).normalized();
  return p.normal.cast<double>().dot(toEye) > (camera.elevation > kAbove ? kLevel : kGrazing);
}

/** The points around the objects, and those that belong to objects. The latter are few and small,
 * so that the ellipsoids can be seen and compared with them. */
struct CloudParts
{
  mrpt::opengl::CPointCloudColoured::Ptr around = mrpt::opengl::CPointCloudColoured::Create();
  mrpt::opengl::CPointCloudColoured::Ptr inside = mrpt::opengl::CPointCloudColoured::Create();
};

/** \param camera If it is given, only the points that face its eye are taken. */
CloudParts cloudOf(
    const SceneContent& content, const SceneOptions& options, const RenderCamera* camera)
{
  Eigen::AlignedBox3d shown = boundsOf(content);
  shown.min().array() -= options.cloudMargin;
  shown.max().array() += options.cloudMargin;
  CloudParts parts;
  parts.around->setName("cloud");
  parts.inside->setName("cloud of the objects");
  std::size_t insideCount = 0;
  for (const CloudPoint& p : content.cloud)
  {
    const Eigen::Vector3d position = p.position.cast<double>();
    if (!shown.contains(position)) continue;
    if (camera && !facesEye(p, *camera)) continue;
    const bool inside = isInside(position, content.objects);
    if (inside && insideCount++ % options.insideThinning != 0) continue;
    const double paleness = inside ? 0.0 : options.cloudPaleness;
    const auto color = [&](std::size_t i) { return paleColor(p.rgb[i], paleness); };
    (inside ? parts.inside : parts.around)
        ->push_back(
            p.position.x(), p.position.y(), p.position.z(), color(0), color(1), color(2), 1.0F);
  }
  return parts;
}

/** The parts that scenes and pictures have in common: all but cloud and labels.
 * \param lineRadius Half the width of the thickest lines [m]. */
mrpt::opengl::COpenGLScene::Ptr commonParts(
    const SceneContent& content, const SceneOptions& options, double lineRadius)
{
  auto scene = mrpt::opengl::COpenGLScene::Create();
  scene->getViewport()->setCustomBackgroundColor(kBackground);
  mrpt::opengl::TLightParameters& light = scene->getViewport()->lightParameters();
  light.ambient = kAmbientLight;
  light.diffuse = kDiffuseLight;
  light.specular = kSpecularLight;
  scene->insert(floorGrid(content));
  if (content.odometryDiffers())
    scene->insert(
        lineThrough(content.odometry, FlatMesh("odometry", kOdometryColor), 0.6 * lineRadius));
  scene->insert(
      lineThrough(content.trajectory, FlatMesh("trajectory", kTrajectoryColor), lineRadius));
  scene->insert(camerasOf(content, options, 0.5 * lineRadius));
  scene->insert(truthOf(content, 0.5 * lineRadius));
  scene->insert(objectsOf(content, 0.8 * lineRadius));
  return scene;
}

}  // namespace

mrpt::opengl::COpenGLScene::Ptr SceneBuilder::scene(const SceneContent& content) const
{
  const RenderCamera camera = obliqueCamera(content, PictureSize().aspect());
  auto scene = commonParts(content, options_, options_.lineRadius);
  const CloudParts cloud = cloudOf(content, options_, nullptr);
  cloud.around->setPointSize(3.0F);
  cloud.inside->setPointSize(2.0F);
  scene->insert(cloud.around);
  scene->insert(cloud.inside);
  scene->insert(standingLabels(content.objects, camera, options_.labelHeight));
  camera.applyTo(scene->getViewport()->getCamera());
  return scene;
}

mrpt::opengl::COpenGLScene::Ptr SceneBuilder::picture(
    const SceneContent& content, const RenderCamera& camera, const PictureSize& size) const
{
  const double metresPerHeight = 2 * std::tan(0.5 * camera.verticalFov) * camera.distance;
  auto scene = commonParts(content, options_, options_.pictureLineRadius * metresPerHeight);

  const CloudParts cloud = cloudOf(content, options_, &camera);
  constexpr double kOverlap = 1.3;  // size of a point / distance of points, which leaves no gaps
  const double pixelsPerMetre = PictureSize::kOversampling * size.height / metresPerHeight;
  const double gap = content.cloudCellSize * pixelsPerMetre;  // [px]
  cloud.around->setPointSize(static_cast<float>(std::clamp(kOverlap * gap, 1.0, 40.0)));
  cloud.inside->setPointSize(static_cast<float>(std::clamp(0.5 * gap, 1.0, 6.0)));
  scene->insert(cloud.around);
  scene->insert(cloud.inside);

  camera.applyTo(scene->getViewport()->getCamera());
  return scene;
}

void writeScene(const mrpt::opengl::COpenGLScene& scene, const std::string& path)
{
  writeArchive(path, scene);
}

}  // namespace quadmap
