#include "page/PageData.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>

#include "page/Base64.h"
#include "quadmap/base/Json.h"
#include "quadmap/obs/DoubtfulObject.h"
#include "quadmap/obs/LabelColor.h"

namespace quadmap
{
namespace
{
constexpr int kMillimetres = 4;  // decimals of lengths [m]: tenths of them

/** Where the cloud's numbers begin, and how long their steps are. */
struct CloudGrid
{
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  float step = 1;  //!< [m]

  explicit CloudGrid(const Cloud& cloud)
  {
    if (cloud.empty()) return;
    Eigen::AlignedBox3f box;
    for (const CloudPoint& p : cloud) box.extend(p.position);
    origin = box.min();
    constexpr float kLargest = std::numeric_limits<std::uint16_t>::max();
    step = std::max(box.sizes().maxCoeff() / kLargest, 1e-6F);
  }
};

Json vectorJson(const Eigen::Vector3d& v)
{
  Json json = Json::array();
  for (int i = 0; i < 3; ++i) json.push_back(rounded(v[i], kMillimetres));
  return json;
}

/** x, y, z and the quaternion x, y, z, w. */
Json poseJson(const mrpt::poses::CPose3D& pose)
{
  mrpt::math::CQuaternionDouble q;
  pose.getAsQuaternion(q);
  Json json = vectorJson({pose.x(), pose.y(), pose.z()});
  for (const double v : {q.x(), q.y(), q.z(), q.r()}) json.push_back(rounded(v, 5));
  return json;
}

Json trajectoryJson(const std::vector<mrpt::poses::CPose3D>& poses)
{
  Json json = Json::array();
  for (const auto& pose : poses) json.push_back(vectorJson({pose.x(), pose.y(), pose.z()}));
  return json;
}

/** Standard deviations of centre [m], yaw [rad], and of the sizes' logarithms. */
Json sigmaJson(const ObjectRecord& record)
{
  if (!record.covariance) return nullptr;
  Json json = Json::array();
  for (int i = 0; i < 7; ++i)
    json.push_back(rounded(std::sqrt(std::max(0.0, (*record.covariance)(i, i))), 5));
  return json;
}

Json numberOrNull(const std::optional<double>& value)
{
  return value ? rounded(*value, 6) : Json();
}

Json colorJson(const std::string& label)
{
  const mrpt::img::TColor color = labelColor(label);
  return {color.R, color.G, color.B};
}

Json objectJson(const PageObject& object)
{
  const ObjectRecord& r = object.record;
  const Eigen::Vector3d size = 2 * r.object.semiAxes();
  Json json = {
      {       "id",                                            r.id},
      {    "label",                                         r.label},
      {   "center",                   vectorJson(r.object.center())},
      {     "size",                                vectorJson(size)},
      {     "pose",                       poseJson(r.object.pose())},
      {      "yaw",                   rounded(r.object.pose().yaw(),6)},
      { "oriented",                            r.orientationDefined                                               },
      {    "color",                              colorJson(r.label)},
      {"confirmed",                                object.confirmed                                               },
      {   "misses",                                   object.misses},
      {    "first",           numberOrNull(object.record.firstSeen)                                               },
      {     "last",            numberOrNull(object.record.lastSeen)},
      {    "sigma",                                    sigmaJson(r)                                               },
      {"existence",              r.existence ? rounded(*r.existence,4) : Json()},
      {    "views", r.observations ? Json(*r.observations) : Json()                                               }
  };
  json["counts"] = Json::object();
  for (const auto& [label, count] : r.labelCounts) json["counts"][label] = count;
  return json;
}

Json objectsJson(const std::vector<PageObject>& objects)
{
  Json json = Json::array();
  for (const PageObject& object : objects) json.push_back(objectJson(object));
  return json;
}

Json labelsJson(const std::vector<std::string>& labels)
{
  Json json = Json::array();
  for (const std::string& label : labels)
    json.push_back({
        { "name",            label},
        {"color", colorJson(label)}
    });
  return json;
}

Json keyframeJson(const PageKeyframe& keyframe)
{
  Json boxes = Json::array();
  for (const PageBox& b : keyframe.boxes)
    boxes.push_back({
        { "label",                                                      b.label                  },
        {  "kind",                                                                         b.kind},
        {"reason",                                                                       b.reason},
        { "score",                                                                rounded(b.score,2)},
        {   "box",
         {rounded(b.box.x1, 1), rounded(b.box.y1, 1), rounded(b.box.x2, 1), rounded(b.box.y2, 1)}                                                                              },
        {"object",                            b.object ? Json(std::to_string(*b.object)) : Json()}
    });
  return {
      {  "time",                                                                rounded(keyframe.time, 6)},
      {"sensor",                                                                      keyframe.sensor   },
      {  "pose",                                               poseJson(keyframe.camera.T_map_sensor)   },
      {   "fov", {rounded(keyframe.camera.horizontalFov, 4), rounded(keyframe.camera.verticalFov, 4)}   },
      {  "size",                                                    {keyframe.width, keyframe.height}   },
      { "boxes",                                                                                boxes   },
      {  "jpeg",                                                                base64(keyframe.jpeg)   }
  };
}

void replaceAll(std::string& text, const std::string& from, const std::string& to)
{
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

}  // namespace

std::string pageJson(const PageContent& content)
{
  const CloudGrid grid(content.scene.cloud);
  Json json = {
      {          "title",                            content.title},
      {      "mapSha256",                        content.mapSha256},
      {          "floor",      rounded(content.scene.floorHeight(),kMillimetres)},
      {  "sureExistence",                           kSureExistence                                        },
      {        "objects",             objectsJson(content.objects)},
      {         "labels",               labelsJson(content.labels)                                        },
      {     "trajectory", trajectoryJson(content.scene.trajectory)},
      {       "odometry",   trajectoryJson(content.scene.odometry)                                        },
      {          "cloud",                                       {}},
      {   "comparedName",                     content.comparedName                                        },
      {"comparedIsTruth",                  content.comparedIsTruth},
      {       "compared",            objectsJson(content.compared)                                        }
  };
  json["cloud"] = {
      {"points",                          content.scene.cloud.size()},
      {"origin", {grid.origin.x(), grid.origin.y(), grid.origin.z()}},
      {  "step",                                           grid.step}
  };
  json["keyframes"] = Json::array();
  for (const PageKeyframe& keyframe : content.keyframes)
    json["keyframes"].push_back(keyframeJson(keyframe));
  std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  replaceAll(text, "<", "\\u003c");
  replaceAll(text, ">", "\\u003e");
  replaceAll(text, "&", "\\u0026");
  return text;
}

std::string pageCloud(const Cloud& cloud)
{
  constexpr unsigned kSeed = 1;
  std::vector<std::uint32_t> order(cloud.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
  std::mt19937 random(kSeed);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);

  const CloudGrid grid(cloud);
  std::string bytes;
  bytes.reserve(12 * cloud.size());
  for (const std::uint32_t index : order)
    for (int i = 0; i < 3; ++i)
    {
      const float steps = (cloud[index].position[i] - grid.origin[i]) / grid.step;
      const auto value = static_cast<std::uint16_t>(std::lround(std::clamp(steps, 0.F, 65535.F)));
      bytes += static_cast<char>(value & 0xFF);
      bytes += static_cast<char>(value >> 8);
    }
  for (const std::uint32_t index : order)
    for (const std::uint8_t channel : cloud[index].rgb) bytes += static_cast<char>(channel);
  for (const std::uint32_t index : order)
    for (int i = 0; i < 3; ++i)
      bytes += static_cast<char>(std::lround(127 * std::clamp(cloud[index].normal[i], -1.F, 1.F)));
  return bytes;
}

std::string safeScript(const std::string& script, const std::string& name)
{
  if (script.find("<!--") != std::string::npos)
    throw std::runtime_error(name + ": holds \"<!--\" and cannot stand in a page");
  std::string safe = script;
  for (const char* word : {"script", "SCRIPT", "Script"})
  {
    replaceAll(safe, std::string("</") + word, std::string("<\\/") + word);
    if (safe.find(std::string("<") + word) != std::string::npos)
      throw std::runtime_error(name + ": holds \"<" + word + "\" and cannot stand in a page");
  }
  return safe;
}

}  // namespace quadmap
