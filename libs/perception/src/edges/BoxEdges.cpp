#include "quadmap/perception/BoxEdges.h"

#include <algorithm>
#include <cmath>

#include "quadmap/obs/FrameAgreement.h"
#include "quadmap/perception/PerceptionOptions.h"

namespace quadmap
{
double distanceToBorder(const PinholeCamera& camera, const ImageBox& box, BoxEdge edge)
{
  switch (edge)
  {
    case BoxEdge::Left:
      return box.x1;
    case BoxEdge::Top:
      return box.y1;
    case BoxEdge::Right:
      return camera.width - 1 - box.x2;
    default:
      return camera.height - 1 - box.y2;
  }
}

std::array<EdgeMeasurement, 4> edgesWithoutDepth(
    const PinholeCamera& camera, const ImageBox& box, const PerceptionOptions& options)
{
  const double margin = options.borderMarginIn(camera.width);
  const auto planes = boxEdgePlanes(camera, box);
  std::array<EdgeMeasurement, 4> out;
  for (std::size_t i = 0; i < out.size(); ++i)
  {
    const auto edge = static_cast<BoxEdge>(i);
    const bool upright = edge == BoxEdge::Left || edge == BoxEdge::Right;
    out[i].plane_sensor = planes[i].transformed(T_sensor_optical());
    const double size = upright ? box.width() : box.height();
    const double sigma = options.edgeSigmaIn(camera.width, size);
    out[i].sigmaAngle = sigma / std::abs(upright ? camera.fx : camera.fy);
    if (margin > 0 && distanceToBorder(camera, box, edge) < margin)
      out[i].state = EdgeState::NearImageBorder;
  }
  return out;
}

void measureWithoutDepth(CObservationObjects& boxes, const PerceptionOptions& options)
{
  requireCalibration(
      boxes.cameraParams, "the camera of the boxes of \"" + boxes.sensorLabel + "\"");
  const PinholeCamera camera = pinholeFrom(boxes.cameraParams);
  for (auto& detected : boxes.objects)
  {
    ObjectMeasurement& m = detected.measurement;
    m = {};
    m.kind = MeasurementKind::Rejected;
    const bool visible =
        detected.box.isValid() && detected.box.clipped(camera.width, camera.height).isValid();
    m.reason = visible ? "every box edge is at the image border" : "no box in the image";
    if (!visible) continue;
    const auto edges = edgesWithoutDepth(camera, detected.box, options);
    if (std::none_of(
            edges.begin(), edges.end(),
            [](const EdgeMeasurement& e) { return e.state == EdgeState::Usable; }))
      continue;
    m.kind = MeasurementKind::Partial;
    m.reason = "box edges alone";
    m.edges = edges;
  }
}

}  // namespace quadmap
