#include "quadmap/dense/ObjectPoints.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <numeric>

#include "BackgroundPlanes.h"
#include "BoxViews.h"
#include "FramePoints.h"
#include "GridCloud.h"
#include "quadmap/base/OutputSet.h"

namespace quadmap
{
namespace
{
/** Where the points of an object are looked for, and what is known about them. */
struct Search
{
  const ObjectRecord* record = nullptr;
  Eigen::Vector3f center = Eigen::Vector3f::Zero();
  float radius = 0;
  std::vector<BoxView> views;
  double boxSize = 0;  // median side of its boxes, at the range of the object [m]
};

Search searchOf(const ObjectRecord& record)
{
  Search search;
  search.record = &record;
  search.center = record.object.center().cast<float>();
  search.radius = static_cast<float>(1.5 * record.object.semiAxes().norm() + 0.25);
  return search;
}

/** The grid of all points near the objects; collects the views of each on the way. */
class NearbyPoints
{
 public:
  NearbyPoints(const std::vector<ObjectRecord>& objects, const DenseOptions& options) :
      options_(options), grid_(options.objectCell)
  {
    for (std::size_t i = 0; i < objects.size(); ++i)
    {
      searches_.push_back(searchOf(objects[i]));
      indexOf_[objects[i].id] = i;
    }
  }

  void add(const KeyframeScan& image)
  {
    addViews(image);
    forEachPoint(
        image, options_,
        [&](const MeasuredPoint& point)
        {
          for (const Search& search : searches_)
            if ((point.position - search.center).squaredNorm() < search.radius * search.radius)
              return grid_.add(point);
        });
  }

  const PointGrid& grid() const { return grid_; }
  const std::vector<Search>& searches() const { return searches_; }

  void finish()
  {
    for (Search& search : searches_)
    {
      std::vector<double> sizes;
      for (const BoxView& view : search.views)
      {
        const double range = (view.eye() - search.center.cast<double>()).norm();
        sizes.push_back(std::sqrt(view.box.area()) * range / view.camera.fx);
      }
      if (sizes.empty()) continue;
      std::nth_element(
          sizes.begin(), sizes.begin() + std::ptrdiff_t(sizes.size() / 2), sizes.end());
      search.boxSize = sizes[sizes.size() / 2];
    }
  }

 private:
  void addViews(const KeyframeScan& image)
  {
    if (!image.boxes || image.objectOfBox.size() != image.boxes->objects.size()) return;
    for (std::size_t box = 0; box < image.objectOfBox.size(); ++box)
    {
      if (!image.objectOfBox[box]) continue;
      const auto index = indexOf_.find(std::to_string(*image.objectOfBox[box]));
      if (index == indexOf_.end()) continue;
      if (const auto view = boxViewOf(image, box)) searches_[index->second].views.push_back(*view);
    }
  }

  DenseOptions options_;
  std::vector<Search> searches_;
  std::map<std::string, std::size_t> indexOf_;
  PointGrid grid_;
};

/** Takes the points of the objects out of the grid, small objects first: what stands on a table is
 * in the boxes of the table, too. */
class Separation
{
 public:
  Separation(const NearbyPoints& points, const DenseOptions& options) :
      grid_(points.grid()), options_(options), cells_(trustedCells(grid_, options))
  {
    cloud_ = cloudOf(grid_, cells_, options);
    isTaken_.assign(cells_.size(), false);
  }

  ObjectPoints take(const Search& search)
  {
    ObjectPoints out;
    out.record = *search.record;
    const auto views = spread(search.views);
    for (const BoxView& view : views) out.eyes.push_back(view.eye());
    std::vector<NearPoint> near, candidates;
    std::vector<std::size_t> indices;  // of the candidates
    for (std::size_t i = 0; i < cloud_.size(); ++i)
    {
      if ((cloud_[i].position - search.center).norm() > search.radius) continue;
      const Eigen::Vector3d p = cloud_[i].position.cast<double>();
      NearPoint point{
          p, cloud_[i].normal.cast<double>(), grid_.weight(cells_[i]), boxShare(views, p)};
      near.push_back(point);
      if (point.share < options_.boxShare || isTaken_[i]) continue;
      candidates.push_back(point);
      indices.push_back(i);
    }
    const auto background = backgroundOf(near, candidates, out);
    keepForeground(background, candidates, indices);
    const auto kept = mainParts(candidates, indices);
    for (const std::size_t i : kept)
    {
      isTaken_[i] = true;
      out.cloud.push_back(cloud_[i]);
      out.weights.push_back(grid_.weight(cells_[i]));
    }
    return out;
  }

 private:
  /** At most so many views, evenly chosen: neighbouring images say the same. */
  static std::vector<BoxView> spread(const std::vector<BoxView>& views)
  {
    constexpr std::size_t kMost = 60;
    if (views.size() <= kMost) return views;
    std::vector<BoxView> some;
    for (std::size_t i = 0; i < kMost; ++i) some.push_back(views[i * views.size() / kMost]);
    return some;
  }

  std::vector<BackgroundPlane> backgroundOf(
      const std::vector<NearPoint>& near,
      const std::vector<NearPoint>& candidates,
      ObjectPoints& out) const
  {
    const auto support = supportOf(near, candidates);
    if (!support) return wallsOf(near, candidates);
    out.supportHeight = support->distance;
    std::vector<NearPoint> standing;
    for (const NearPoint& point : candidates)
      if (support->height(point.position) > clearanceOf(*support)) standing.push_back(point);
    auto planes = wallsOf(near, standing);
    planes.push_back(*support);
    return planes;
  }

  double clearanceOf(const BackgroundPlane& plane) const
  {
    return std::max(options_.clearance, 2.5 * plane.spread);
  }

  void keepForeground(
      const std::vector<BackgroundPlane>& background,
      std::vector<NearPoint>& candidates,
      std::vector<std::size_t>& indices) const
  {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
      const bool isBackground = std::any_of(
          background.begin(), background.end(),
          [&](const BackgroundPlane& plane)
          { return plane.height(candidates[i].position) <= clearanceOf(plane); });
      if (isBackground) continue;
      candidates[kept] = candidates[i];
      indices[kept++] = indices[i];
    }
    candidates.resize(kept);
    indices.resize(kept);
  }

  /** The largest part of the candidates, and others that are surely within the boxes. */
  std::vector<std::size_t> mainParts(
      const std::vector<NearPoint>& candidates, const std::vector<std::size_t>& indices) const
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
      for (const std::size_t i : part) kept.push_back(indices[i]);
    }
    std::sort(kept.begin(), kept.end());
    return kept;
  }

  const PointGrid& grid_;
  DenseOptions options_;
  std::vector<std::size_t> cells_;  // of the grid, without outliers
  DenseCloud cloud_;                // their points
  std::vector<bool> isTaken_;
};

/** ID_LABEL with nothing that could mean something to a file system or a shell. */
std::string fileNameOf(const ObjectRecord& record)
{
  std::string name = record.id + "_" + record.label;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  return name + ".pcd";
}

}  // namespace

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
  const auto& searches = points.searches();
  std::vector<std::size_t> order(searches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(
      order.begin(), order.end(),
      [&](std::size_t a, std::size_t b) { return searches[a].boxSize < searches[b].boxSize; });
  Separation separation(points, options);
  std::vector<ObjectPoints> found(objects.size());
  for (const std::size_t i : order) found[i] = separation.take(searches[i]);
  return found;
}

std::vector<std::string> writeObjectClouds(
    const std::vector<ObjectPoints>& objects, const std::string& folder)
{
  std::filesystem::create_directories(folder);
  OutputSet files(folder, "object-clouds");
  for (const ObjectPoints& object : objects)
    if (!object.cloud.empty()) writeCloud(object.cloud, files.add(fileNameOf(object.record)));
  files.commit();
  return files.names();
}

}  // namespace quadmap
