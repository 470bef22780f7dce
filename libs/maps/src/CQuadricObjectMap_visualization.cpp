#include <mrpt/core/format.h>
#include <mrpt/img/TColor.h>
#include <mrpt/opengl/CBox.h>
#include <mrpt/opengl/CEllipsoid3D.h>
#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CText3D.h>

#include "quadmap/base/GzipStream.h"
#include "quadmap/base/OutputFile.h"
#include "quadmap/maps/CQuadricObjectMap.h"
#include "quadmap/obs/LabelColor.h"

namespace quadmap
{
namespace
{
mrpt::math::TPoint3D asPoint(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

void drawCuboid(
    const MapObject& object, const mrpt::img::TColorf& color, mrpt::opengl::CSetOfObjects& out)
{
  const auto half = asPoint(object.object.semiAxes());
  auto box =
      mrpt::opengl::CBox::Create(mrpt::math::TPoint3D(-half.x, -half.y, -half.z), half, true, 2.0f);
  box->setPose(object.object.pose());
  box->setColor(mrpt::img::TColorf(color.R, color.G, color.B, 1.0f));
  out.insert(box);
}

void drawEllipsoid(
    const MapObject& object, const mrpt::img::TColorf& color, mrpt::opengl::CSetOfObjects& out)
{
  // The rotation goes into the pose: with off-diagonal covariances MRPT draws it wrongly.
  mrpt::math::CMatrixDouble33 covariance;
  for (int i = 0; i < 3; ++i)
    covariance(i, i) = object.object.semiAxes()[i] * object.object.semiAxes()[i];
  auto ellipsoid = mrpt::opengl::CEllipsoid3D::Create();
  ellipsoid->setCovMatrix(covariance);
  ellipsoid->setQuantiles(1.0f);
  ellipsoid->enableDrawSolid3D(true);
  ellipsoid->setPose(object.object.pose());
  ellipsoid->setColor(color);
  out.insert(ellipsoid);
}

void drawLabel(
    const MapObject& object,
    const mrpt::img::TColorf& color,
    double height,
    mrpt::opengl::CSetOfObjects& out)
{
  auto text = mrpt::opengl::CText3D::Create(
      mrpt::format("%s %u", object.label().c_str(), object.id), "sans", static_cast<float>(height));
  Eigen::Vector3d top = object.object.center();
  top.z() += object.object.semiAxes().z() + 0.3 * height;
  // Upright, readable from the map's -y side.
  text->setPose(mrpt::poses::CPose3D(top.x(), top.y(), top.z(), 0, 0, M_PI / 2));
  text->setColor(mrpt::img::TColorf(color.R, color.G, color.B, 1.0f));
  out.insert(text);
}

}  // namespace

void CQuadricObjectMap::getVisualizationInto(mrpt::opengl::CSetOfObjects& out) const
{
  if (!genericMapParams.enableSaveAs3DObject) return;
  for (const auto& [id, object] : objects_)
  {
    if (!object.confirmed && !renderOptions.unconfirmed) continue;
    mrpt::img::TColorf color(labelColor(object.label()));
    color.A = static_cast<float>(renderOptions.opacity);
    if (!object.confirmed) color = {0.6f, 0.6f, 0.6f, color.A};
    if (renderOptions.cuboids) drawCuboid(object, color, out);
    if (renderOptions.ellipsoids) drawEllipsoid(object, color, out);
    if (renderOptions.labels) drawLabel(object, color, renderOptions.textHeight, out);
  }
}

void CQuadricObjectMap::saveMetricMapRepresentationToFile(const std::string& prefix) const
{
  writeObjectsJson(prefix + ".json", toRecords());
  writeTextFile(prefix + ".txt", asString() + "\n");

  mrpt::opengl::COpenGLScene scene;
  scene.insert(mrpt::opengl::CGridPlaneXY::Create(-10.f, 10.f, -10.f, 10.f, 0.f, 1.f));
  auto objects = mrpt::opengl::CSetOfObjects::Create();
  getVisualizationInto(*objects);
  scene.insert(objects);
  writeArchive(prefix + ".3Dscene", scene);
}

}  // namespace quadmap
