#include "quadmap/obs/CObservationObjects.h"

#include <mrpt/core/format.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <ostream>

#include "ObjectsArchive.h"
#include "quadmap/base/ArchiveFields.h"

using mrpt::obs::CObservation;
IMPLEMENTS_SERIALIZABLE(CObservationObjects, CObservation, quadmap)

namespace quadmap
{
namespace
{
/** The text as one word, for a column. */
std::string word(std::string text)
{
  for (char& c : text)
    if (static_cast<unsigned char>(c) <= ' ') c = '_';
  return text.empty() ? "-" : text;
}

void describe(std::ostream& o, const DetectedObject& object)
{
  o << mrpt::format(
      "  %s score %.2f box (%.1f, %.1f)-(%.1f, %.1f) px", object.label.c_str(), object.score,
      object.box.x1, object.box.y1, object.box.x2, object.box.y2);
  if (object.instanceId) o << ", instance " << *object.instanceId;
  if (object.mask) o << ", mask " << object.mask->width << "x" << object.mask->height << " px";
  o << "\n    measurement: " << nameOf(object.measurement.kind);
  if (!object.measurement.reason.empty()) o << " (" << object.measurement.reason << ")";
  if (const auto& complete = object.measurement.complete)
  {
    const auto center = complete->object_sensor.center();
    const Eigen::Vector3d size = 2.0 * complete->object_sensor.semiAxes();
    o << mrpt::format(
        "\n    center (%.3f, %.3f, %.3f) m in the sensor frame, size %.3f x %.3f x %.3f m, yaw %s",
        center.x(), center.y(), center.z(), size.x(), size.y(), size.z(),
        complete->yawDefined ? "defined" : "undefined");
  }
  o << "\n";
}

/** The columns of one object, with "nan" where there is no such number. */
std::string textColumns(const DetectedObject& o)
{
  Eigen::Vector3d center = Eigen::Vector3d::Constant(NAN), size = center;
  if (const auto& complete = o.measurement.complete)
  {
    center = complete->object_sensor.center();
    size = 2.0 * complete->object_sensor.semiAxes();
  }
  std::string text = mrpt::format(
      "%s %.4f %.3f %.3f %.3f %.3f %s %s", word(o.label).c_str(), o.score, o.box.x1, o.box.y1,
      o.box.x2, o.box.y2, o.instanceId ? std::to_string(*o.instanceId).c_str() : "-",
      nameOf(o.measurement.kind));
  for (const auto& v : {center, size}) text += mrpt::format(" %.6f %.6f %.6f", v.x(), v.y(), v.z());
  return text;
}

}  // namespace

const char* nameOf(MeasurementKind kind)
{
  switch (kind)
  {
    case MeasurementKind::Complete:
      return "complete";
    case MeasurementKind::Partial:
      return "partial";
    case MeasurementKind::Rejected:
      return "rejected";
    case MeasurementKind::None:
      break;
  }
  return "none";
}

uint8_t CObservationObjects::serializeGetVersion() const { return 0; }

void CObservationObjects::serializeTo(mrpt::serialization::CArchive& out) const
{
  requireStored(objects.size() <= kMostObjects, "too many objects");
  out << timestamp;
  writeText(out, sensorLabel);
  writePose(out, sensorPose);
  writeCamera(out, cameraParams);
  writeCoarseDepth(out, coarseDepth);
  out.WriteAs<std::uint32_t>(objects.size());
  ObjectsBudget left;
  for (const auto& object : objects) writeDetectedObject(out, object, left);
}

void CObservationObjects::serializeFrom(mrpt::serialization::CArchive& in, uint8_t version)
{
  if (version != 0) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
  in >> timestamp;
  sensorLabel = readText(in);
  sensorPose = readPose(in);
  cameraParams = readCamera(in);
  coarseDepth = readCoarseDepth(in);
  const auto count = readCount(in, kMostObjects, "objects");
  objects.clear();
  ObjectsBudget left;
  for (std::uint32_t i = 0; i < count; ++i) objects.push_back(readDetectedObject(in, left));
}

void CObservationObjects::getDescriptionAsText(std::ostream& o) const
{
  CObservation::getDescriptionAsText(o);
  o << "Sensor pose on the robot: " << sensorPose << "\n"
    << "Image: " << cameraParams.ncols << "x" << cameraParams.nrows << " px, fx "
    << cameraParams.fx() << " fy " << cameraParams.fy() << " cx " << cameraParams.cx() << " cy "
    << cameraParams.cy() << "\n"
    << "Coarse depth: " << coarseDepth.columns << "x" << coarseDepth.rows << " cells\n"
    << "Objects: " << objects.size() << "\n";
  for (const auto& object : objects) describe(o, object);
}

std::string CObservationObjects::exportTxtHeader() const
{
  return "image_width image_height objects, then for each object: label score x1 y1 x2 y2 "
         "instance measurement center_x center_y center_z size_x size_y size_z";
}

std::string CObservationObjects::exportTxtDataRow() const
{
  std::string row =
      mrpt::format("%u %u %zu", cameraParams.ncols, cameraParams.nrows, objects.size());
  for (const auto& object : objects) row += " " + textColumns(object);
  return row;
}

PinholeCamera pinholeFrom(const mrpt::img::TCamera& camera)
{
  return {camera.fx(), camera.fy(), camera.cx(), camera.cy(), camera.ncols, camera.nrows};
}

void registerObsClasses() { mrpt::rtti::registerClass(CLASS_ID(CObservationObjects)); }

namespace
{
/** Registers the class when the library is loaded. With Clang, MRPT_INITIALIZER would run before
 * the description of the class exists. */
const struct Registration
{
  Registration() { registerObsClasses(); }
} registration;

}  // namespace

}  // namespace quadmap
