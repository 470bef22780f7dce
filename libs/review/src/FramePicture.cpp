#include "quadmap/review/FramePicture.h"

#include <mrpt/core/format.h>

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "FrameCanvas.h"
#include "quadmap/base/ErrorText.h"
#include "quadmap/obs/LabelColor.h"

namespace quadmap
{
namespace
{
const cv::Scalar kGreen(60, 220, 60), kGrey(150, 150, 150), kWhite(255, 255, 255);
const cv::Scalar kYellow(0, 220, 255);

/** The colour of a label, mixed with white as far as it needs to be seen on dark ground: that of
 * texts is dark, and the thin lines have dark rims. */
cv::Scalar colorOf(const std::string& label)
{
  constexpr double kLeastBrightness = 140;
  const mrpt::img::TColor c = labelColor(label);
  const cv::Scalar color(c.B, c.G, c.R);
  const double brightness = 0.114 * color[0] + 0.587 * color[1] + 0.299 * color[2];
  const double share = std::max(0.0, (kLeastBrightness - brightness) / (255 - brightness));
  return color * (1 - share) + kWhite * share;
}

/** The depth image as greys, black where there is none and white near by. */
cv::Mat greyDepth(const mrpt::obs::CObservation3DRangeScan& scan)
{
  constexpr double kFarthest = 6.0;  // [m]
  const int rows = static_cast<int>(scan.cameraParams.nrows);
  const int columns = static_cast<int>(scan.cameraParams.ncols);
  cv::Mat grey(rows, columns, CV_8U, cv::Scalar(0));
  for (int v = 0; v < rows && scan.hasRangeImage; ++v)
    for (int u = 0; u < columns; ++u)
    {
      const double depth = scan.rangeImage(v, u) * static_cast<double>(scan.rangeUnits);
      if (depth > 0 && depth < kFarthest)
        grey.at<std::uint8_t>(v, u) =
            cv::saturate_cast<std::uint8_t>(255 - 215 * depth / kFarthest);
    }
  return grey;
}

/** Three channels of 8 bits, in the size of the calibration. */
cv::Mat imageOf(const FramePictureContent& content)
{
  const auto& scan = *content.scan;
  cv::Mat image;
  if (content.image)
    image = content.image->asCvMatRef();
  else if (scan.hasIntensityImage && !scan.intensityImage.isEmpty())
    image = scan.intensityImage.asCvMatRef();
  else
    image = greyDepth(scan);
  if (image.depth() == CV_16U)
  {
    cv::Mat narrow;
    image.convertTo(narrow, CV_8U, 1 / 256.0);
    image = narrow;
  }
  cv::Mat bgr = image;
  if (image.channels() == 1) cv::cvtColor(image, bgr, cv::COLOR_GRAY2BGR);
  const cv::Size size(
      static_cast<int>(scan.cameraParams.ncols), static_cast<int>(scan.cameraParams.nrows));
  cv::Mat scaled = bgr;
  if (bgr.size() != size) cv::resize(bgr, scaled, size, 0, 0, cv::INTER_AREA);
  return scaled;
}

/** Draws all parts of a picture onto its canvas. */
class FramePainter
{
 public:
  explicit FramePainter(const FramePictureContent& content) :
      content_(content),
      canvas_(imageOf(content), pinholeFrom(content.scan->cameraParams)),
      T_optical_sensor_(-T_sensor_optical())
  {
  }

  mrpt::img::CImage paint()
  {
    static const std::vector<DetectedObject> kNone;
    const auto& boxes = content_.boxes ? content_.boxes->objects : kNone;
    for (const auto& box : boxes)
      if (box.mask) canvas_.tint(*box.mask, colorOf(box.label));
    for (const auto& object : content_.objects) paintObject(object);
    for (const auto& box : boxes) paintMeasurement(box.measurement);
    for (const auto& box : boxes) paintEdges(box);
    // Texts go where earlier ones leave room, so that the most important come first.
    for (std::size_t i = 0; i < boxes.size(); ++i) writeModel(boxes[i], i);
    for (const auto& [top, id] : ids_) canvas_.textsBelow(top, {id});
    for (const auto& box : boxes) writeReasons(box);
    return {canvas_.picture(), mrpt::img::DEEP_COPY};
  }

 private:
  void paintObject(const ObjectInFrame& object)
  {
    const cv::Scalar color = colorOf(object.label);
    const Ellipsoid object_optical = object.object_sensor.transformed(T_optical_sensor_);
    canvas_.cuboid(object_optical, color);
    if (const auto top = canvas_.outline(object_optical, color))
      ids_.push_back({
          *top, {"#" + object.id, color}
      });
  }

  void paintMeasurement(const ObjectMeasurement& measurement)
  {
    if (!measurement.complete) return;
    constexpr std::size_t kBottom = 5;  // face -z
    const Ellipsoid object_optical =
        measurement.complete->object_sensor.transformed(T_optical_sensor_);
    if (measurement.complete->faces[kBottom].kind == FaceKind::Support)
      canvas_.fillBottom(object_optical, kYellow);
    canvas_.cuboid(object_optical, kWhite);
  }

  /** An edge of a box. */
  struct Edge
  {
    Eigen::Vector2d from, to;
    EdgeState state = EdgeState::Usable;
  };

  /** Left, top, right, bottom. */
  static std::array<Edge, 4> edgesOf(const DetectedObject& object)
  {
    const ImageBox& b = object.box;
    const std::array<Eigen::Vector2d, 4> corners{
        {{b.x1, b.y1}, {b.x2, b.y1}, {b.x2, b.y2}, {b.x1, b.y2}}
    };
    std::array<Edge, 4> edges;
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
      edges[i] = {corners[(i + 3) % 4], corners[i]};
      if (object.measurement.edges) edges[i].state = (*object.measurement.edges)[i].state;
    }
    return edges;
  }

  void paintEdges(const DetectedObject& object)
  {
    const bool isMeasured = object.measurement.kind != MeasurementKind::None;
    const bool isUnusable = isMeasured && !object.measurement.edges;
    for (const Edge& edge : edgesOf(object))
    {
      cv::Scalar color = isMeasured ? kGreen : colorOf(object.label);
      if (isUnusable || edge.state != EdgeState::Usable) color = kGrey;
      canvas_.line(edge.from, edge.to, color, FrameCanvas::Weight::Bold);
    }
  }

  void writeReasons(const DetectedObject& object)
  {
    for (const Edge& edge : edgesOf(object))
      if (edge.state != EdgeState::Usable)
        canvas_.textsBelow(
            (edge.from + edge.to) / 2,
            {
                {edge.state == EdgeState::Occluded ? "occluded" : "cut by the image", kGrey}
        });
  }

  void writeModel(const DetectedObject& object, std::size_t index)
  {
    std::string head = mrpt::format("%s %.2f", oneLine(object.label).c_str(), object.score);
    if (index < content_.objectOfBox.size())
      head += content_.objectOfBox[index].empty() ? ", no object"
                                                  : ", object #" + content_.objectOfBox[index];
    FrameCanvas::Texts rows{
        {head, kWhite}
    };
    const ObjectMeasurement& m = object.measurement;
    if (m.kind != MeasurementKind::None)
      rows.push_back(
          {std::string(nameOf(m.kind)) + ": " + oneLine(m.reason),
           m.kind == MeasurementKind::Rejected ? kGrey : kGreen});
    canvas_.textsAbove({object.box.x1, object.box.y1}, rows);  // not on the object
  }

  const FramePictureContent& content_;
  FrameCanvas canvas_;
  mrpt::poses::CPose3D T_optical_sensor_;
  /** Where the ids of objects go, and these. */
  std::vector<std::pair<Eigen::Vector2d, FrameCanvas::Text>> ids_;
};

}  // namespace

mrpt::img::CImage drawFrame(const FramePictureContent& content)
{
  return FramePainter(content).paint();
}

}  // namespace quadmap
