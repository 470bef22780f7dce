#include "NearbyPoints.h"

#include <algorithm>
#include <cmath>

namespace quadmap
{
namespace
{
ObjectSearch searchOf(const ObjectRecord& record)
{
  ObjectSearch search;
  search.record = &record;
  search.center = record.object.center().cast<float>();
  search.radius = static_cast<float>(1.25 * record.object.semiAxes().norm() + 0.25);
  return search;
}

}  // namespace

NearbyPoints::NearbyPoints(const std::vector<ObjectRecord>& objects, const DenseOptions& options) :
    options_(options), grid_(options.objectCell)
{
  for (std::size_t i = 0; i < objects.size(); ++i)
  {
    searches_.push_back(searchOf(objects[i]));
    indexOf_[objects[i].id] = i;
  }
}

void NearbyPoints::add(const KeyframeScan& image)
{
  addViews(image);
  forEachPoint(
      image, options_,
      [&](const MeasuredPoint& point)
      {
        for (const ObjectSearch& search : searches_)
          if ((point.position - search.center).squaredNorm() < search.radius * search.radius)
            return grid_.add(point);
      });
}

void NearbyPoints::finish()
{
  for (ObjectSearch& search : searches_)
  {
    std::vector<double> sizes;
    for (const DenseBoxView& view : search.views)
    {
      const double range = (view.eye() - search.center.cast<double>()).norm();
      sizes.push_back(std::sqrt(view.box.area()) * range / view.camera.fx);
    }
    if (sizes.empty()) continue;
    std::nth_element(sizes.begin(), sizes.begin() + std::ptrdiff_t(sizes.size() / 2), sizes.end());
    search.boxSize = sizes[sizes.size() / 2];
  }
}

void NearbyPoints::addViews(const KeyframeScan& image)
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

}  // namespace quadmap
