#include "quadmap/maps/WaitingList.h"

#include <algorithm>

#include "quadmap/geometry/ViewAngles.h"

namespace quadmap
{
namespace
{
/** The parallax of their common centre [rad]. */
double parallaxOf(const std::vector<WaitingList::Entry>& entries)
{
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> cameras;
  for (const auto& e : entries)
  {
    center += e.view.center / static_cast<double>(entries.size());
    cameras.push_back(e.view.camera);
  }
  return parallax(center, cameras);
}

/** Two boxes of one image are two things, or one thing twice. They are not two views of it. */
bool areOfOneImage(const WaitingList::Entry& a, const WaitingList::Entry& b)
{
  return a.time == b.time && a.view.camera == b.view.camera;
}

}  // namespace

std::vector<WaitingList::Entry> WaitingList::add(
    Entry entry, const LabelTable& labels, const WaitingOptions& options)
{
  const double gate = 0.1 + options.gateShare * 2.0 * entry.view.halfSizes.mean();
  const auto agrees = [&](const Entry& other)
  {
    return labels.compatible(other.view.label, entry.view.label) &&
           (other.view.center - entry.view.center).norm() <= gate;
  };
  const auto isNearer = [&](const Entry& a, const Entry& b) {
    return (a.view.center - entry.view.center).norm() < (b.view.center - entry.view.center).norm();
  };
  std::vector<Entry> group;  // of each image the measurement that agrees best
  for (const Entry& other : entries_)
  {
    if (!agrees(other) || areOfOneImage(other, entry)) continue;
    const auto sameImage = std::find_if(
        group.begin(), group.end(), [&](const Entry& e) { return areOfOneImage(e, other); });
    if (sameImage == group.end())
      group.push_back(other);
    else if (isNearer(other, *sameImage))
      *sameImage = other;
  }
  group.push_back(entry);

  if (group.size() >= static_cast<std::size_t>(options.minViews) &&
      parallaxOf(group) >= options.minParallax)
  {
    entries_.erase(std::remove_if(entries_.begin(), entries_.end(), agrees), entries_.end());
    return group;
  }
  entries_.push_back(std::move(entry));
  while (entries_.size() > static_cast<std::size_t>(options.capacity)) entries_.pop_front();
  return {};
}

}  // namespace quadmap
