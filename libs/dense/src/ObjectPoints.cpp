#include "quadmap/dense/ObjectPoints.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <set>

#include "Background.h"
#include "GridCloud.h"
#include "NearbyPoints.h"
#include "quadmap/base/OutputGroup.h"

namespace quadmap
{
namespace
{
/** The views that say where an object ends on three sides, or all when there are few of them. At
 * most so many, evenly chosen: neighbouring images say the same. */
std::vector<DenseBoxView> tellingViews(const std::vector<DenseBoxView>& views)
{
  constexpr std::size_t kMost = 40, kFew = 5;
  std::vector<DenseBoxView> telling;
  for (const DenseBoxView& view : views)
    if (std::count(view.usable.begin(), view.usable.end(), true) >= 3) telling.push_back(view);
  if (telling.size() < kFew) telling = views;
  if (telling.size() <= kMost) return telling;
  std::vector<DenseBoxView> some;
  for (std::size_t i = 0; i < kMost; ++i) some.push_back(telling[i * telling.size() / kMost]);
  return some;
}

/** Gives the points of the grid to the objects. */
class Separation
{
 public:
  Separation(const NearbyPoints& points, const DenseOptions& options) :
      grid_(points.grid()), options_(options), cells_(trustedCells(grid_, options))
  {
    cloud_ = cloudOf(grid_, cells_, options);
    claims_.resize(cloud_.size());
    for (const ObjectSearch& search : points.searches()) near_.push_back(nearPoints(search));
    for (std::size_t i = 0; i < near_.size(); ++i) claim(i, points.searches()[i].boxSize);
  }

  ObjectPoints take(std::size_t object, const ObjectSearch& search) const
  {
    ObjectPoints out;
    out.record = *search.record;
    for (const DenseBoxView& view : search.views)
    {
      out.eyes.push_back(view.eye());
      out.boxesWithTop += view.usable[1] ? 1 : 0;
    }
    std::vector<NearPoint> near, candidates;
    std::vector<std::size_t> indices;  // of the candidates
    for (const auto& [i, share] : near_[object])
    {
      near.push_back(pointOf(i, share));
      if (claims_[i].object != object || share < static_cast<float>(options_.boxShare)) continue;
      candidates.push_back(near.back());
      indices.push_back(i);
    }
    smooth(candidates);
    const auto background = backgroundOf(near, candidates, out);
    keepForeground(background, candidates, indices);
    std::set<std::size_t> own;
    for (const std::size_t i : mainParts(candidates))
    {
      own.insert(indices[i]);
      out.cloud.push_back(cloud_[indices[i]]);
      out.cloud.back().position = candidates[i].position.cast<float>();
      out.weights.push_back(static_cast<float>(candidates[i].weight));
    }
    for (const auto& entry : near_[object])
      if (own.count(entry.point) == 0 && !background.contains(pointOf(entry.point, 0).position))
        out.others.push_back(cloud_[entry.point].position);
    return out;
  }

 private:
  /** A point near an object, and the share of the object's boxes in which it lies. */
  struct Near
  {
    std::size_t point;
    float share;
  };

  /** Which object a point belongs to. */
  struct Claim
  {
    static constexpr std::size_t kNobody = static_cast<std::size_t>(-1);
    std::size_t object = kNobody;
    float share = 0;
    double boxSize = 0;
  };

  std::vector<Near> nearPoints(const ObjectSearch& search) const
  {
    const auto views = tellingViews(search.views);
    std::vector<Near> near;
    for (std::size_t i = 0; i < cloud_.size(); ++i)
    {
      const Eigen::Vector3f& p = cloud_[i].position;
      if ((p - search.center).squaredNorm() < search.radius * search.radius)
        near.push_back({i, static_cast<float>(boxShare(views, p.cast<double>()))});
    }
    return near;
  }

  /** What stands on a table is in the boxes of the table, too: of two objects with about the same
   * share a point belongs to that with smaller boxes. */
  void claim(std::size_t object, double boxSize)
  {
    constexpr float kSameShare = 0.15F;
    const auto fewest = static_cast<float>(options_.boxShare) - kSameShare;
    for (const auto& [i, share] : near_[object])
    {
      Claim& claim = claims_[i];
      if (share < fewest) continue;
      const bool isBetter = std::abs(share - claim.share) < kSameShare ? boxSize < claim.boxSize
                                                                       : share > claim.share;
      if (claim.object == Claim::kNobody || isBetter) claim = {object, share, boxSize};
    }
  }

  NearPoint pointOf(std::size_t i, float share) const
  {
    return {
        cloud_[i].position.cast<double>(), cloud_[i].normal.cast<double>(), grid_.weight(cells_[i]),
        share};
  }

  /** Moves points onto the surfaces they scatter about. */
  void smooth(std::vector<NearPoint>& points) const
  {
    pointOperations::Points positions;
    std::vector<float> weights;
    for (const NearPoint& point : points)
    {
      positions.push_back(point.position.cast<float>());
      weights.push_back(static_cast<float>(point.weight));
    }
    for (int round = 0; round < 2; ++round)
      positions = pointOperations::ontoSurface(positions, weights, options_.smoothingRadius);
    for (std::size_t i = 0; i < positions.size(); ++i)
      points[i].position = positions[i].cast<double>();
  }

  Background backgroundOf(
      const std::vector<NearPoint>& near,
      const std::vector<NearPoint>& candidates,
      ObjectPoints& out) const
  {
    Background background(options_.clearance);
    std::vector<NearPoint> standing = candidates;
    if (const auto support = supportOf(near, candidates))
    {
      out.supportHeight = support->distance;
      background.addSupport(*support, near, candidates);
      standing.erase(
          std::remove_if(
              standing.begin(), standing.end(),
              [&](const NearPoint& point) { return background.contains(point.position); }),
          standing.end());
    }
    background.add(wallsOf(near, standing));
    return background;
  }

  void keepForeground(
      const Background& background,
      std::vector<NearPoint>& candidates,
      std::vector<std::size_t>& indices) const
  {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
      if (background.contains(candidates[i].position)) continue;
      candidates[kept] = candidates[i];
      indices[kept++] = indices[i];
    }
    candidates.resize(kept);
    indices.resize(kept);
  }

  /** The largest part of the candidates, and others that are surely within the boxes. */
  std::vector<std::size_t> mainParts(const std::vector<NearPoint>& candidates) const
  {
    constexpr double kSurely = 0.9;       // mean share of the boxes
    constexpr double kWorthwhile = 0.03;  // of the points of the largest part
    pointOperations::Points positions;
    for (const NearPoint& point : candidates) positions.push_back(point.position.cast<float>());
    std::vector<std::size_t> kept;
    std::size_t largest = 0;
    for (const auto& part : pointOperations::connectedParts(positions, options_.growDistance))
    {
      largest = std::max(largest, part.size());
      double share = 0;
      for (const std::size_t i : part) share += candidates[i].share;
      share /= static_cast<double>(part.size());
      const bool isMain = kept.empty();
      const bool isWorthwhile =
          static_cast<double>(part.size()) >= kWorthwhile * static_cast<double>(largest);
      if (!isMain && (share < kSurely || !isWorthwhile)) continue;
      kept.insert(kept.end(), part.begin(), part.end());
    }
    std::sort(kept.begin(), kept.end());
    return kept;
  }

  const PointGrid& grid_;
  DenseOptions options_;
  std::vector<std::size_t> cells_;       // of the grid, without outliers
  DenseCloud cloud_;                     // their points
  std::vector<std::vector<Near>> near_;  // of each object
  std::vector<Claim> claims_;            // of each point
};

/** Whether a file is one that this library wrote for an object: its name is like those of
 * fileNameOf() and, as the user chooses the folder of clouds, a cloud begins as ours do. */
bool isOfAnObject(const std::filesystem::directory_entry& file, const std::string& extension)
{
  const std::string stem = file.path().stem().string();
  const bool isNamedSo =
      file.path().extension() == extension && stem.find('_') != std::string::npos &&
      std::all_of(
          stem.begin(), stem.end(),
          [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; });
  if (!isNamedSo || file.symlink_status().type() != std::filesystem::file_type::regular)
    return false;
  if (extension != ".pcd") return true;
  std::string firstLine;
  std::getline(std::ifstream(file.path()), firstLine);
  return firstLine.rfind("# .PCD v0.7 - quadmap", 0) == 0;
}

}  // namespace

std::string fileNameOf(const ObjectRecord& record, const std::string& extension)
{
  constexpr std::size_t kLongestLabel = 64;  // of the 255 bytes that a name may have
  std::string name = record.id + "_" + record.label.substr(0, kLongestLabel);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  return name + extension;
}

void removeFormerFiles(OutputSet& files, const std::string& extension)
{
  const auto names = files.names();
  for (const auto& file : std::filesystem::directory_iterator(files.folder()))
  {
    const std::string name = file.path().filename().string();
    if (std::find(names.begin(), names.end(), name) == names.end() && isOfAnObject(file, extension))
      files.addRemoval(name);
  }
}

std::vector<ObjectPoints> findObjectPoints(
    const std::string& result,
    const std::vector<ObjectRecord>& objects,
    const DenseOptions& options,
    const std::function<void(double)>& progress)
{
  NearbyPoints points(objects, options);
  forEachDepthImage(
      result, ResultKeyframes::Boxes::Read, options,
      [&](const KeyframeScan& image) { points.add(image); }, progress);
  points.finish();
  const Separation separation(points, options);
  std::vector<ObjectPoints> found;
  for (std::size_t i = 0; i < objects.size(); ++i)
    found.push_back(separation.take(i, points.searches()[i]));
  return found;
}

std::vector<std::string> writeObjectClouds(
    const std::vector<ObjectPoints>& objects, const std::string& folder, OutputGroup& group)
{
  OutputSet& files = group.addFolder(folder, "object-clouds");
  for (const ObjectPoints& object : objects)
    if (!object.cloud.empty())
      writeCloud(object.cloud, files.add(fileNameOf(object.record, ".pcd")));
  removeFormerFiles(files, ".pcd");
  return files.names();
}

}  // namespace quadmap
