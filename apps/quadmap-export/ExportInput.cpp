#include "ExportInput.h"

#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "quadmap/base/ErrorText.h"
#include "quadmap/base/Sha256.h"
#include "quadmap/evaluation/EvaluationReport.h"
#include "quadmap/maps/MapFile.h"
#include "quadmap/maps/ObjectRecords.h"
#include "quadmap/obs/Trajectory.h"
#include "quadmap/review/KeyframeContent.h"
#include "quadmap/review/PageKeyframes.h"

namespace quadmap
{
namespace
{
namespace fs = std::filesystem;

std::vector<mrpt::poses::CPose3D> posesOf(const fs::path& path)
{
  std::vector<mrpt::poses::CPose3D> poses;
  if (!fs::exists(path)) return poses;
  for (const StampedPose& stamped : readTumTrajectory(path.string())) poses.push_back(stamped.pose);
  return poses;
}

/** The true objects in the frame of the map, with labels as the map spells them. */
std::vector<ObjectRecord> readTruth(const ExportInput& input, const LabelTable& labels)
{
  std::vector<ObjectRecord> truth = readObjectsJson(*input.truthPath);
  for (ObjectRecord& record : truth) record.label = labels.canonical(record.label);
  if (input.inPlace) return truth;
  if (!fs::is_directory(input.path))
    throw std::runtime_error(
        input.path + ": a map file has no trajectory to align the truth by; give the folder");
  EvaluationInput alignment;
  alignment.estimate = input.path;
  alignment.trueTrajectoryPath = input.trajectoryPath;
  const EvaluationReport aligned = evaluateRun(alignment);
  for (const std::string& note : aligned.notes)
    std::cerr << "quadmap-export: note: " << oneLine(note) << "\n";
  const mrpt::poses::CPose3D T_map_truth = -aligned.T_truth_estimated;
  for (ObjectRecord& record : truth)
  {
    if (aligned.reflection) record.object = (*aligned.reflection)(record.object);
    record.object = record.object.transformed(T_map_truth);
  }
  return truth;
}

/** Marks the estimated objects that are none of the true ones, and the true ones that were missed.
 */
void compare(const ExportInput& input, SceneContent& content)
try
{
  const ObjectEvaluation comparison = evaluateObjects(content.truth, content.objects, {});
  for (const ObjectRecord& record : comparison.spurious) content.phantoms.insert(record.id);
  for (const ObjectRecord& record : comparison.missed) content.missed.insert(record.id);
}
catch (const TooManyObjects& e)
{
  throw std::runtime_error(*input.truthPath + " and " + input.path + ": " + e.what());
}

SceneContent readScene(
    const ExportInput& input, const CQuadricObjectMap& map, const KeyframeVisitor& visit)
{
  SceneContent content;
  content.objects = map.toRecords();
  if (input.truthPath)
  {
    content.truth = readTruth(input, map.labels());
    compare(input, content);
  }
  const fs::path path = input.path;
  if (!fs::is_directory(path)) return content;
  content.trajectory = posesOf(path / "trajectory.tum");
  content.odometry = posesOf(path / "trajectory_odometry.tum");
  const fs::path keyframes = path / "map.simplemap";
  if (input.withCloud && fs::exists(keyframes))
    addKeyframes(keyframes.string(), {}, content, visit);
  return content;
}

PageObject pageObjectOf(const MapObject& object)
{
  PageObject out;
  out.record = recordOf(object);
  out.confirmed = object.confirmed;
  out.misses = object.missCount;
  return out;
}

std::vector<PageObject> pageObjectsOf(const CQuadricObjectMap& map)
{
  std::vector<PageObject> objects;
  for (const auto& entry : map.objects()) objects.push_back(pageObjectOf(entry.second));
  return objects;
}

/** What a page calls a map or a truth: its folder, or a file with a name of its own. Pages are
 * passed on, and in whose folders they were made is nobody else's business. */
std::string shownName(const std::string& path)
{
  fs::path whole = fs::absolute(path).lexically_normal();
  if (whole.filename().empty()) whole = whole.parent_path();  // of "home/"
  const bool isUsualName = whole.stem() == "objects" && whole.extension() != ".json";
  return (isUsualName ? whole.parent_path() : whole).filename().string();
}

/** Fills in the truth or the second map. */
void addCompared(
    const ExportInput& input, const std::optional<std::string>& mapPath, PageContent& content)
{
  if (mapPath)
  {
    content.comparedName = shownName(*mapPath);
    content.compared = pageObjectsOf(readMap(*mapPath));
  }
  else if (input.truthPath)
  {
    content.comparedName = shownName(*input.truthPath);
    content.comparedIsTruth = true;
    for (const ObjectRecord& record : content.scene.truth)
    {
      content.compared.emplace_back();
      content.compared.back().record = record;
    }
  }
}

}  // namespace

SceneContent readExportInput(const ExportInput& input)
{
  return readScene(input, readMap(input.path), {});
}

PageContent readPageInput(
    const ExportInput& input, const std::optional<std::string>& comparedMapPath)
{
  const CQuadricObjectMap map = readMap(input.path);
  std::optional<PageImages> images;
  const auto visit = [&images](const auto& scan, const CameraPose& camera, std::size_t keyframes)
  {
    if (!images) images.emplace(PageImageOptions(), keyframes);
    images->add(scan, camera);
  };
  PageContent content;
  content.title = shownName(input.path);
  content.mapSha256 = sha256OfFile(mapFileOf(input.path));
  content.scene = readScene(input, map, visit);
  content.objects = pageObjectsOf(map);
  for (const auto& entry : map.labels().all()) content.labels.push_back(entry.first);
  if (images) content.keyframes = std::move(images->keyframes());
  const fs::path boxes = fs::path(input.path) / "objects.simplemap";
  if (fs::exists(boxes))
    addPageBoxes(
        boxes.string(), (fs::path(input.path) / "report.json").string(), content.keyframes);
  addCompared(input, comparedMapPath, content);
  return content;
}

}  // namespace quadmap
