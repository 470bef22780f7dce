#pragma once

#include <map>
#include <string>
#include <vector>

#include "BoxViews.h"
#include "FramePoints.h"
#include "quadmap/obs/ObjectList.h"

namespace quadmap
{
/** Where the points of an object are looked for, and what is known about them. */
struct ObjectSearch
{
  const ObjectRecord* record = nullptr;
  Eigen::Vector3f center = Eigen::Vector3f::Zero();
  float radius = 0;
  std::vector<DenseBoxView> views;
  double boxSize = 0;  // median side of its boxes, at the range of the object [m]
};

/** The grid of all points near the objects; collects the views of each on the way. */
class NearbyPoints
{
 public:
  NearbyPoints(const std::vector<ObjectRecord>& objects, const DenseOptions& options);

  void add(const KeyframeScan& image);

  /** Call it when all images were added. */
  void finish();

  const PointGrid& grid() const { return grid_; }
  const std::vector<ObjectSearch>& searches() const { return searches_; }

 private:
  void addViews(const KeyframeScan& image);

  DenseOptions options_;
  std::vector<ObjectSearch> searches_;
  std::map<std::string, std::size_t> indexOf_;
  PointGrid grid_;
};

}  // namespace quadmap
