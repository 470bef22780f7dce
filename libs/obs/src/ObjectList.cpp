#include "quadmap/obs/ObjectList.h"

#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "quadmap/base/Json.h"
#include "quadmap/base/OutputFile.h"
#include "quadmap/obs/Plausible.h"

namespace quadmap
{
namespace
{
const char* const kFormat = "quadmap-objects";
constexpr int kVersion = 1;

[[noreturn]] void reject(const std::string& what) { throw std::runtime_error(what); }

const Json& require(const Json& object, const char* key)
{
  const auto found = object.find(key);
  if (found == object.end()) reject(std::string("\"") + key + "\" is missing");
  return *found;
}

double readFinite(const Json& value, const char* key)
{
  const double number = value.is_number() ? value.get<double>() : NAN;
  if (!std::isfinite(number)) reject(std::string("\"") + key + "\" must be of finite numbers");
  return number;
}

double readTime(const Json& value, const char* key)
{
  const double time = readFinite(value, key);
  if (!(std::abs(time) <= kLatestTime))
    reject(std::string("\"") + key + "\" is no time in seconds: " + jsonText(value));
  return time;
}

double readProbability(const Json& value, const char* key)
{
  const double probability = readFinite(value, key);
  if (!(probability >= 0 && probability <= 1))
    reject(std::string("\"") + key + "\" is " + jsonText(value) + ", and not in [0, 1]");
  return probability;
}

unsigned readCount(const Json& value, const char* key)
{
  constexpr std::uint64_t kMost = std::numeric_limits<unsigned>::max();
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > kMost)
    reject(std::string("\"") + key + "\" must be a whole number >= 0");
  return value.get<unsigned>();
}

template <int ROWS, int COLUMNS>
Eigen::Matrix<double, ROWS, COLUMNS> readMatrix(const Json& value, const char* key)
{
  const auto shape = std::to_string(ROWS) + (COLUMNS == 1 ? "" : "x" + std::to_string(COLUMNS));
  const auto check = [&](const Json& array, std::size_t size)
  {
    if (!array.is_array() || array.size() != size)
      reject(std::string("\"") + key + "\" must be an array of " + shape + " numbers");
  };
  Eigen::Matrix<double, ROWS, COLUMNS> m;
  check(value, ROWS);
  for (int row = 0; row < ROWS; ++row)
  {
    const Json& line = value[static_cast<std::size_t>(row)];
    if (COLUMNS == 1)
    {
      m(row, 0) = readFinite(line, key);
      continue;
    }
    check(line, COLUMNS);
    for (int column = 0; column < COLUMNS; ++column)
      m(row, column) = readFinite(line[static_cast<std::size_t>(column)], key);
  }
  return m;
}

std::string readId(const Json& value)
{
  if (value.is_number_integer()) return value.dump();
  if (value.is_string() && !value.get<std::string>().empty()) return value.get<std::string>();
  reject("\"id\" must be a whole number or a text");
}

/** Reads a matrix and returns the rotation nearest to it. */
Eigen::Matrix3d readRotation(const Json& value)
{
  const Eigen::Matrix3d r = readMatrix<3, 3>(value, "rotation");
  if (!isRotation(r))
    reject("\"rotation\" is not a rotation: its columns must be orthonormal and right-handed");
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(r, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

Ellipsoid readEllipsoid(const Json& object, bool orientationDefined)
{
  const Eigen::Vector3d center = readMatrix<3, 1>(require(object, "center"), "center");
  const Eigen::Vector3d size = readMatrix<3, 1>(require(object, "size"), "size");
  if (!(size.minCoeff() > 0)) reject("\"size\" must be > 0");
  if (const auto why = whyNoSize(size)) reject("\"size\" " + *why);
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  if (orientationDefined || object.contains("rotation"))
    rotation = readRotation(require(object, "rotation"));
  const mrpt::math::CMatrixDouble33 r(rotation);
  const auto pose = mrpt::poses::CPose3D::FromRotationAndTranslation(
      r, mrpt::math::TPoint3D(center.x(), center.y(), center.z()));
  if (const auto why = whyNoPose(pose)) reject("\"center\" " + *why);
  return Ellipsoid(pose, 0.5 * size);
}

ObjectRecord readRecord(const Json& object)
{
  if (!object.is_object()) reject("must be a JSON object");
  ObjectRecord record;
  record.id = readId(require(object, "id"));
  const Json& label = require(object, "label");
  if (!label.is_string()) reject("\"label\" must be a text");
  record.label = label.get<std::string>();
  if (object.contains("orientation_defined"))
  {
    const Json& defined = object["orientation_defined"];
    if (!defined.is_boolean()) reject("\"orientation_defined\" must be true or false");
    record.orientationDefined = defined.get<bool>();
  }
  record.object = readEllipsoid(object, record.orientationDefined);
  if (object.contains("frames_visible"))
    record.framesVisible = readCount(object["frames_visible"], "frames_visible");
  if (object.contains("from")) record.from = readTime(object["from"], "from");
  if (object.contains("to")) record.to = readTime(object["to"], "to");
  if (object.contains("observations"))
    record.observations = readCount(object["observations"], "observations");
  if (object.contains("existence"))
    record.existence = readProbability(object["existence"], "existence");
  if (object.contains("first_seen"))
    record.firstSeen = readTime(object["first_seen"], "first_seen");
  if (object.contains("last_seen")) record.lastSeen = readTime(object["last_seen"], "last_seen");
  if (object.contains("label_counts"))
  {
    const Json& counts = object["label_counts"];
    if (!counts.is_object()) reject("\"label_counts\" must be a JSON object");
    for (const auto& [name, count] : counts.items())
      record.labelCounts[name] = readCount(count, "label_counts");
  }
  if (object.contains("covariance"))
    record.covariance = readMatrix<7, 7>(object["covariance"], "covariance");
  return record;
}

std::string describeRecord(const Json& object, std::size_t index)
{
  std::string name = "object " + std::to_string(index);
  if (object.is_object() && object.contains("id") && object["id"].is_primitive())
    name += " (id " + jsonText(object["id"]) + ")";
  return name;
}

template <typename Derived>
Json jsonOf(const Eigen::MatrixBase<Derived>& m)
{
  Json rows = Json::array();
  for (int row = 0; row < m.rows(); ++row)
  {
    Json line = Json::array();
    for (int column = 0; column < m.cols(); ++column) line.push_back(double(m(row, column)));
    rows.push_back(m.cols() == 1 ? line[0] : line);
  }
  return rows;
}

/** Whether the text is a whole number that reads back as the same text. */
bool isPlainNumber(const std::string& id)
{
  constexpr std::size_t kExactInEveryReader = 15;  // digits that a double always keeps
  return !id.empty() && id.size() <= kExactInEveryReader &&
         id.find_first_not_of("0123456789") == std::string::npos && (id == "0" || id[0] != '0');
}

Json jsonOf(const ObjectRecord& record)
{
  if (record.covariance && !record.covariance->allFinite())
    throw std::invalid_argument("object " + record.id + ": its covariance is not finite");
  if (record.existence && !std::isfinite(*record.existence))
    throw std::invalid_argument("object " + record.id + ": its existence is not finite");
  Json j;
  if (isPlainNumber(record.id))
    j["id"] = std::stoull(record.id);
  else
    j["id"] = record.id;
  j["label"] = record.label;
  j["center"] = jsonOf(record.object.center());
  j["size"] = jsonOf((2.0 * record.object.semiAxes()).eval());
  j["rotation"] = jsonOf(record.object.rotation());
  j["orientation_defined"] = record.orientationDefined;
  if (record.framesVisible) j["frames_visible"] = *record.framesVisible;
  if (record.from) j["from"] = *record.from;
  if (record.to) j["to"] = *record.to;
  if (record.observations) j["observations"] = *record.observations;
  if (record.existence) j["existence"] = *record.existence;
  if (record.firstSeen) j["first_seen"] = rounded(*record.firstSeen, 6);
  if (record.lastSeen) j["last_seen"] = rounded(*record.lastSeen, 6);
  if (!record.labelCounts.empty()) j["label_counts"] = record.labelCounts;
  if (record.covariance) j["covariance"] = jsonOf(*record.covariance);
  return j;
}

/** Files that people or other programs made may have neither format nor version nor unit. */
void requireKnownForm(const Json& file)
{
  if (file.contains("format") && file["format"] != kFormat)
    reject("\"format\" is " + jsonText(file["format"]) + ", and not \"" + kFormat + "\"");
  if (file.contains("version") && file["version"] != kVersion)
    reject(
        "\"version\" is " + jsonText(file["version"]) + "; this program reads version " +
        std::to_string(kVersion));
  if (file.contains("unit") && file["unit"] != "m")
    reject("\"unit\" is " + jsonText(file["unit"]) + ", and not \"m\"");
}

std::vector<ObjectRecord> recordsOf(const Json& file)
{
  if (!file.is_object()) reject("expected {\"objects\": [...]}");
  requireKnownForm(file);
  const Json& objects = require(file, "objects");
  if (!objects.is_array()) reject("\"objects\" must be an array");

  std::vector<ObjectRecord> records;
  std::set<std::string> ids;
  for (std::size_t i = 0; i < objects.size(); ++i)
  {
    try
    {
      records.push_back(readRecord(objects[i]));
      if (!ids.insert(records.back().id).second) reject("its \"id\" stands in the file twice");
    }
    catch (const std::exception& e)
    {
      reject(describeRecord(objects[i], i) + ": " + e.what());
    }
  }
  return records;
}

}  // namespace

std::vector<ObjectRecord> readObjectsJson(const std::string& path)
{
  const Json file = readJson(path);
  try
  {
    return recordsOf(file);
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error(path + ": " + e.what());
  }
}

std::string objectsToJson(const std::vector<ObjectRecord>& objects, const std::string& frame)
{
  const Json head{
      { "format",  kFormat},
      {"version", kVersion},
      {   "unit",      "m"},
      {  "frame",    frame}
  };
  std::string text = jsonText(head);
  text.back() = ',';  // the closing brace comes after the objects
  text += "\n\"objects\":[";
  for (std::size_t i = 0; i < objects.size(); ++i)
    text += (i == 0 ? "\n " : ",\n ") + jsonText(jsonOf(objects[i]));
  return text + "\n]}\n";
}

void writeObjectsJson(
    const std::string& path, const std::vector<ObjectRecord>& objects, const std::string& frame)
{
  writeTextFile(path, objectsToJson(objects, frame));
}

}  // namespace quadmap
